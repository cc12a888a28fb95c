#include "fracture/breaking_bonds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fracture/noise.h"

namespace windfall::fracture {

namespace {

/// Strain at which dry wood leaves the straight line; real wood tears at about 0.01 (Wood Handbook 2010,
/// ch. 5: strength over modulus). A little more makes the bending visible before it breaks.
constexpr double kDryStrain = 0.008;
constexpr double kWetStrain = 0.02;
/// How far the hinge can be crushed, radii.
constexpr double kCrushed = 0.1;
/// Sideways way at which a bond is torn, radii.
constexpr double kSheared = 0.3;

/// Toughness of the wood at a distance from the pith: pith is weak, bark and phloem hold like string.
double tissue_toughness(const TissueParameters& tissue, double radius) {
    if (radius <= tissue.pith) return 0.5;
    if (radius <= tissue.pith + tissue.heartwood) return 0.8;
    if (radius <= 1 - tissue.phloem) return 1;
    return 1.4;
}

}  // namespace

std::vector<BondStrength> bond_strengths(const FractureParameters& parameters,
                                         const BreakingLattice& lattice) {
    const bool wet = parameters.species.moisture == Moisture::Wet;
    const TensionField field = tension_field(parameters);
    const std::uint32_t seed = noise_seed(parameters.seed);
    const double ratio = strength_ratio(parameters.species.moisture);
    std::vector<BondStrength> strengths(lattice.plan.size());
    for (std::size_t c = 0; c < strengths.size(); ++c) {
        const double x = lattice.plan.x(c), y = lattice.plan.y(c);
        const auto random = [&](std::uint32_t which) {
            return static_cast<double>(
                random_unit(seed, NoisePurpose::BreakingBond, static_cast<std::uint32_t>(c), which));
        };
        // Also where the amplitude of the bundles is the same all over, the pressed side breaks short.
        const double tension =
            smooth_step(-0.6F, 0.6F, static_cast<float>(x * field.cos_a + y * field.sin_a));
        const double tough = tissue_toughness(parameters.tissue, std::hypot(x, y));
        const double spread = 0.7 + 0.6 * random(0);
        BondStrength& s = strengths[c];
        s.elastic = (wet ? kWetStrain : kDryStrain) * lattice.spacing * spread * tough;
        s.crushing = s.elastic / ratio;
        const double slide = 0.3 + 1.4 * random(1) * random(1);
        s.pull_out = (wet ? 0.45 : 0.2) * (0.15 + 0.85 * tension) * slide * tough;
        s.bend = (wet ? 1.3 : 0.8) * (0.8 + 0.5 * random(2)) * tough;
    }
    return strengths;
}

BreakingBonds::BreakingBonds(const FractureParameters& parameters, const BreakingLattice& lattice)
    : slip(lattice.plan.size(), 0.0), torn_at(lattice.plan.size(), -1.0), m_holding(lattice.plan.size()) {
    const std::vector<BondStrength> strengths = bond_strengths(parameters, lattice);
    const int lowest = lattice.piece.first_level, highest = lattice.stub.last_level;
    for (std::size_t c = 0; c < lattice.plan.size(); ++c) {
        int level = lowest;
        for (int k = lowest; k <= highest; ++k) {
            const auto distance = [&](int at) {
                return std::abs(lattice.levels[static_cast<std::size_t>(at)] - lattice.heights[c]);
            };
            if (distance(k) < distance(level)) level = k;
        }
        Bond bond{};
        bond.stub = lattice.stub.at(level, c);
        bond.piece = lattice.piece.at(level, c);
        bond.below = lattice.stub.at(level - 1, c);
        bond.above = lattice.stub.at(std::min(level + 1, highest), c);
        const double stiffness =
            lattice.wave_speed * lattice.wave_speed * lattice.plan.area(c) / lattice.spacing;
        const double ws = lattice.particles.inverse_mass[bond.stub];
        const double wp = lattice.particles.inverse_mass[bond.piece];
        const double whole = ws + wp + 1 / (stiffness * lattice.step * lattice.step);
        bond.share_stub = ws / whole;
        bond.share_piece = wp / whole;
        bond.strength = strengths[c];
        m_bonds.push_back(bond);
    }
}

Point BreakingBonds::axis(const Bond& bond, const Particles& particles) const {
    return (particles.position[bond.above] - particles.position[bond.below]).normalized();
}

void BreakingBonds::project(Particles& particles) const {
    for (std::size_t c = 0; c < m_bonds.size(); ++c) {
        if (!holds(c)) continue;
        const Bond& bond = m_bonds[c];
        const Point along = axis(bond, particles);
        const Point apart = particles.position[bond.piece] - particles.position[bond.stub];
        const double elastic = apart.dot(along) - slip[c];
        Point sideways = apart - apart.dot(along) * along;
        // Beyond the elastic limit the splinters slide past each other at a constant force.
        const double way = sideways.norm();
        if (way > bond.strength.elastic) sideways *= bond.strength.elastic / way;
        const Point pull = elastic * along + sideways;
        particles.position[bond.stub] += bond.share_stub * pull;
        particles.position[bond.piece] -= bond.share_piece * pull;
    }
}

void BreakingBonds::yield(const Particles& particles, double bend, double weakening, double time) {
    for (std::size_t c = 0; c < m_bonds.size(); ++c) {
        if (!holds(c)) continue;
        const Bond& bond = m_bonds[c];
        const BondStrength& s = bond.strength;
        const Point along = axis(bond, particles);
        const Point apart = particles.position[bond.piece] - particles.position[bond.stub];
        const double lengthening = apart.dot(along);
        const double sideways = (apart - lengthening * along).norm();
        const double pull_out = s.pull_out * weakening;
        const double limit = s.elastic * std::max(0.0, 1 - std::max(slip[c], 0.0) / pull_out);
        slip[c] = std::max(slip[c], lengthening - limit);
        slip[c] = std::max(std::min(slip[c], lengthening + s.crushing), -kCrushed);
        if (slip[c] >= pull_out || bend >= s.bend * weakening || sideways >= kSheared * weakening) {
            torn_at[c] = time;
            --m_holding;
        }
    }
}

void BreakingBonds::recount() {
    m_holding = static_cast<std::size_t>(
        std::count_if(torn_at.begin(), torn_at.end(), [](double time) { return time < 0; }));
}

}  // namespace windfall::fracture
