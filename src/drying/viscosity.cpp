#include "drying/viscosity.h"

#include <algorithm>
#include <cmath>

#include "drying/specimen.h"

namespace windfall::drying {

double viscosity(const DryingParameters& parameters, double shrinkage, double onset) {
    // While wrinkles appear, damping delays them and shifts their length; once they stand it only saves
    // Newton steps.
    constexpr double kFrom = 1.3;
    constexpr double kOver = 0.35;
    const SolverParameters& solver = parameters.solver;
    if (onset < 0) return solver.viscosity;
    // Shorter wrinkles are stiffer against a damping of the same size, by the square of their length; a
    // smaller power was found to cost as little and to change less.
    constexpr double kBaseWaveLength = 0.3754;  // of the base case
    constexpr double kPower = 1.5;
    constexpr double kShortest = 4;  // as far as it was measured: a skin of 0.01
    const double shortness = std::clamp(kBaseWaveLength / expected_wave_length(parameters), 1.0, kShortest);
    const double late = solver.late_viscosity * std::pow(shortness, kPower);
    const double progress = (shrinkage - kFrom * onset) / (kOver * onset);
    return std::lerp(solver.viscosity, late, std::clamp(progress, 0.0, 1.0));
}

}  // namespace windfall::drying
