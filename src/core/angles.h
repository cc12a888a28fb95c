#pragma once
// A full turn, by one name everywhere.
#include <numbers>

namespace windfall {

/// Radians of a full turn.
template <class Real>
inline constexpr Real kTwoPi = 2 * std::numbers::pi_v<Real>;

}  // namespace windfall
