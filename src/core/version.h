#pragma once
#include <string>

namespace windfall {

/// The program's version with the commit that it was built from: "0.1.0+abc1234", with "-dirty" behind it
/// when the tree had changes that were not committed; "0.1.0" alone when built outside a Git checkout.
std::string program_version();

}  // namespace windfall
