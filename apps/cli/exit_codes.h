#pragma once

namespace windfall::cli {

inline constexpr int kExitFailed = 1;       ///< while running: lost equilibrium, a full disk
inline constexpr int kExitWrongInput = 2;   ///< arguments, recipe, a take that exists
inline constexpr int kExitCancelled = 130;  ///< by Ctrl-C or a termination signal, as shells report it

}  // namespace windfall::cli
