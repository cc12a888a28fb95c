#include "core/version.h"

#include "windfall_version.h"

namespace windfall {

std::string program_version() { return WINDFALL_PROGRAM_VERSION; }

}  // namespace windfall
