#include "decay/body_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace windfall::decay {

namespace {

constexpr double kGravity_m_s2 = 9.81;
/// Flesh softer than this many times its own weight's pressure would run out into a puddle.
constexpr double kLeastStanding = 4;

void check_range(const char* name, double value, double least, double most) {
    if (!(value >= least && value <= most))
        throw InputError(fmt::format("body: {} must be {} to {}, not {}", name, least, most, value));
}

}  // namespace

void check_settings(const BodySettings& s) {
    check_range("mass_kg", s.mass_kg, 1e-4, 100);
    check_range("firmness", s.firmness, 1, 100);
    check_range("thickness", s.thickness, 1, 100);
    check_range("softening", s.softening, 1e-4, 1);
    check_range("skin_modulus_pa", s.skin_modulus_pa, 1e3, 1e10);
    check_range("rot_shrinkage", s.rot_shrinkage, 0, 0.8);
    check_range("rot_softening", s.rot_softening, 1, 1e4);
    check_range("rot_depth_m", s.rot_depth_m, 1e-5, 1);
    check_range("wave_length_m", s.wave_length_m, 0, 1);
    check_range("skin_cells", s.skin_cells, 4, 400);
    check_range("flesh_cells", s.flesh_cells, 2, 40);
    check_range("flesh_layers", s.flesh_layers, 2, 20);
    if (s.flesh_cells > s.skin_cells)
        throw InputError(fmt::format("body: flesh_cells ({}) must not be more than skin_cells ({})",
                                     s.flesh_cells, s.skin_cells));
}

void check_load(const BodyLoad& load, std::size_t skin_vertices) {
    check_range("water_fraction_lost", load.water_fraction_lost, 0, 0.95);
    check_range("progress", load.progress, 0, 1);
    check_range("gravity_m_s2", load.gravity_m_s2, 0, 100);
    if (!load.rot.empty() && load.rot.size() != skin_vertices)
        throw InputError(
            fmt::format("body: rot has {} values for {} skin vertices", load.rot.size(), skin_vertices));
}

double fresh_modulus_pa(double firmness) { return 2e3 * std::pow(2000.0, firmness / 100); }

double skin_thickness_of(double thickness) { return 0.05e-3 + 3e-3 * std::pow(thickness / 100, 2); }

FleshMaterial::FleshMaterial(const FleshMesh& mesh, const BodySettings& settings, double density_kg_m3)
    : m_settings(settings),
      m_rot(mesh.tetrahedra.size()),
      m_modulus(mesh.tetrahedra.size()),
      m_theta(mesh.tetrahedra.size()) {
    double lowest = mesh.nodes[0].z();
    double highest = lowest;
    for (const auto& x : mesh.nodes) {
        lowest = std::min(lowest, x.z());
        highest = std::max(highest, x.z());
    }
    m_least_modulus_pa = kLeastStanding * density_kg_m3 * kGravity_m_s2 * (highest - lowest);
    for (std::size_t e = 0; e < m_rot.size(); ++e) {
        double depth = 0;
        for (int k = 0; k < 4; ++k) {
            const auto node = static_cast<std::size_t>(mesh.tetrahedra[e][k]);
            const std::size_t column = mesh.column_of(node);
            const bool centre = column == mesh.columns();
            m_rot[e].column[k] = centre ? m_rot[e].column[0] : static_cast<std::int32_t>(column);
            depth += (mesh.nodes[node] - mesh.nodes[m_rot[e].column[k]]).norm() / 4;
        }
        m_rot[e].reach = static_cast<float>(std::exp(-std::pow(depth / settings.rot_depth_m, 2)));
    }
}

void FleshMaterial::apply(const BodyLoad& load, const std::vector<float>& rot, double mass_ratio) {
    const double sound =
        fresh_modulus_pa(m_settings.firmness) * std::pow(m_settings.softening, load.progress);
    const double dry = std::cbrt(1 - load.water_fraction_lost);
    // The weight that is left stands on a section that has shrunk too.
    const double least = m_least_modulus_pa * std::max(1.0, mass_ratio / (dry * dry));
    const double softening = std::log(m_settings.rot_softening);
    for (std::size_t e = 0; e < m_rot.size(); ++e) {
        float mean = 0;
        for (const auto column : m_rot[e].column) mean += rot[column] / 4;
        const double r = mean * m_rot[e].reach;
        m_theta[e] = dry * (1 - m_settings.rot_shrinkage * r);
        m_modulus[e] = std::max(sound * (r > 0 ? std::exp(-softening * r) : 1.0), least);
    }
}

}  // namespace windfall::decay
