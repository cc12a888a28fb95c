#include "drying/imperfection.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "drying/buckling_modes.h"
#include "drying/specimen.h"
#include "geometry/plane_waves.h"

namespace windfall::drying {

using geometry::LayeredMesh;
using geometry::Vec3;

void add_noise(LayeredMesh& mesh, const DryingParameters& parameters) {
    constexpr int kWaves = 200;
    const ImperfectionParameters& imperfection = parameters.imperfection;
    const double wave_number = 2 * std::numbers::pi / expected_wave_length(parameters);
    const geometry::PlaneWaves waves(static_cast<std::uint64_t>(parameters.seed), kWaves,
                                     wave_number / imperfection.longest_wave,
                                     wave_number / imperfection.shortest_wave);
    const std::vector<Vec3> surface = mesh.level_positions(mesh.flesh_layers);
    std::vector<double> noise(mesh.columns());
    double largest = 0;
    for (std::size_t c = 0; c < noise.size(); ++c) {
        noise[c] = waves.at(surface[c]);
        largest = std::max(largest, std::abs(noise[c]));
    }
    if (largest == 0) return;
    for (std::size_t c = 0; c < noise.size(); ++c) {
        const double displacement = imperfection.amplitude * noise[c] / largest;
        const double flesh = (surface[c] - mesh.base[c]).norm();
        for (int k = 0; k < mesh.layers; ++k) {
            Vec3& node = mesh.nodes[c * mesh.layers + k];
            const double height = std::min(1.0, (node - mesh.base[c]).norm() / flesh);
            node += displacement * height * height * mesh.outward[c];
        }
    }
}

void add_modes(LayeredMesh& mesh, const DryingParameters& parameters, const RunContext& context) {
    const BucklingModes buckling = find_buckling_modes(mesh, parameters, context);
    std::vector<Vec3> mix(mesh.nodes.size(), Vec3::Zero());
    for (std::size_t m = 0; m < buckling.modes.size(); ++m) {
        const double weight = random_normal2(static_cast<std::uint64_t>(parameters.seed),
                                             RandomPurpose::ImperfectionModes, m)[0];
        for (std::size_t i = 0; i < mix.size(); ++i) mix[i] += weight * buckling.modes[m][i];
    }
    double largest = 0;
    for (const Vec3& displacement : mix) largest = std::max(largest, displacement.cwiseAbs().maxCoeff());
    if (largest == 0) return;
    for (std::size_t i = 0; i < mix.size(); ++i)
        mesh.nodes[i] += parameters.imperfection.amplitude / largest * mix[i];
}

void add_imperfection(LayeredMesh& mesh, const DryingParameters& parameters, const RunContext& context) {
    switch (parameters.imperfection.kind) {
        case ImperfectionKind::Noise:
            add_noise(mesh, parameters);
            break;
        case ImperfectionKind::Modes:
            add_modes(mesh, parameters, context);
            break;
        case ImperfectionKind::None:
            return;
    }
    geometry::check_corners(mesh, "make imperfection.amplitude smaller");
}

}  // namespace windfall::drying
