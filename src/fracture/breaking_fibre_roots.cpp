#include "fracture/breaking_fibre_roots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fracture/bending.h"
#include "fracture/breaking_guide.h"
#include "fracture/noise.h"

namespace windfall::fracture {

namespace {

constexpr int kFewest = 14, kMost = 96;
constexpr double kNearMouth = 0.35;  // radii
constexpr std::uint32_t kManyTries = 2000;
constexpr int kStrandsPerFibre = 6;

std::size_t unsigned_of(int i) { return static_cast<std::size_t>(i); }

/// The vertex of the broken surface nearest to a place in the plan.
Point surface_point(const BreakEnds& ends, float x, float y) {
    const Vector3f* nearest = nullptr;
    float least = 0;
    for (std::int32_t v = 0; v < ends.surface_vertices; ++v) {
        const Vector3f& p = ends.stub.positions[unsigned_of(v)];
        const float distance_sq = (p.x() - x) * (p.x() - x) + (p.y() - y) * (p.y() - y);
        if (nearest == nullptr || distance_sq < least) {
            nearest = &p;
            least = distance_sq;
        }
    }
    return point(nearest->x(), nearest->y(), nearest->z());
}

}  // namespace

LatticePoint LatticePoint::in(const BreakingLattice& lattice, const LatticeEnd& end, const Point& unplaced) {
    const DiscPlan& plan = lattice.plan;
    const double ring = std::min(std::hypot(unplaced.x(), unplaced.y()), 1.0) * plan.rings();
    const double sector = std::atan2(unplaced.y(), unplaced.x()) / (2 * std::numbers::pi) * plan.sectors();
    const int r = std::min(static_cast<int>(ring), plan.rings() - 1);
    const int s = static_cast<int>(std::floor(sector));
    const double u = ring - r, v = sector - s;
    const auto found = std::upper_bound(lattice.levels.begin(), lattice.levels.end(), unplaced.z());
    const int k =
        std::clamp(static_cast<int>(found - lattice.levels.begin()) - 1, end.first_level, end.last_level - 1);
    const double low = lattice.levels[unsigned_of(k)], high = lattice.levels[unsigned_of(k) + 1];
    const double w = (unplaced.z() - low) / (high - low);
    LatticePoint result{};
    for (int i = 0; i < 8; ++i) {
        const int dr = i & 1, ds = (i >> 1) & 1, dk = i >> 2;
        result.particles[unsigned_of(i)] =
            static_cast<std::int32_t>(end.at(k + dk, plan.column(r + dr, s + ds)));
        result.weights[unsigned_of(i)] =
            (dr != 0 ? u : 1 - u) * (ds != 0 ? v : 1 - v) * (dk != 0 ? w : 1 - w);
    }
    return result;
}

Point LatticePoint::at(const Particles& particles_now) const {
    Point sum = Point::Zero();
    for (std::size_t i = 0; i < 8; ++i) sum += weights[i] * particles_now.position[unsigned_of(particles[i])];
    return sum;
}

std::vector<BridgingFibre> bridging_fibres(const FractureParameters& parameters, const BreakEnds& ends,
                                           const BreakingLattice& lattice) {
    std::vector<BridgingFibre> fibres;
    const FringeParameters& fringe = parameters.fringe;
    const TensionField field = tension_field(parameters);
    const std::uint32_t seed = noise_seed(parameters.seed);
    const auto strands = static_cast<int>(std::min<std::int64_t>(fringe.strands, 10000));
    const int wanted = std::min(kFewest + strands / kStrandsPerFibre, kMost);
    const std::vector<double> mouths = smoothed_heights(lattice);
    for (std::uint32_t i = 0; fibres.size() < unsigned_of(wanted); ++i) {
        const auto random = [&](std::uint32_t which) {
            return static_cast<double>(random_unit(seed, NoisePurpose::BreakingFibre, i, which));
        };
        // Most of them are bast, the toughest fibres, just under the bark, where nothing hides them.
        const bool bast = random(0) < 0.7;
        const double phloem = std::clamp(parameters.tissue.phloem, 0.05, 0.5);
        const double reach =
            bast ? 1 - phloem * (0.3 + 0.5 * random(11)) : (0.95 - phloem) * std::sqrt(random(11));
        const double angle = 2 * std::numbers::pi * random(1);
        const auto x = static_cast<float>(reach * std::cos(angle));
        const auto y = static_cast<float>(reach * std::sin(angle));
        const double tension = smooth_step(-0.4F, 0.9F, x * field.cos_a + y * field.sin_a);
        if (random(2) > 0.05 + 0.95 * tension) continue;
        BridgingFibre fibre{};
        fibre.name = noise_key(seed, NoisePurpose::BreakingFibre, i, 100);
        fibre.surface = surface_point(ends, x, y);
        // Deep between splinters nobody would see it; where all is deep, any place will do.
        fibre.mouth = lattice.plan.interpolate(mouths, x, y);
        if (!bast && i < kManyTries && std::abs(fibre.surface.z() - fibre.mouth) > kNearMouth) continue;
        const std::array<double, 2> room = {fibre.surface.z() - lattice.levels.front(),
                                            lattice.levels.back() - fibre.surface.z()};
        for (std::uint32_t half = 0; half < 2; ++half) {
            const double length = fringe.strand_length * (0.25 + 0.75 * random(3 + half));
            fibre.length[half] = std::clamp(length, 1e-3, std::max(1e-3, 0.5 * room[half]));
            fibre.most_freed[half] = 2 + static_cast<int>((kHalfNodes - 2) * random(5 + half));
        }
        fibre.radius = 0.5 * fringe.strand_thickness * (0.6 + 0.8 * random(7));
        fibre.tearing = 0.02 + 0.08 * random(8);
        const double bend = 1.5 * fringe.strand_curl * random(9) / kHalfNodes,
                     side = 2 * std::numbers::pi * random(10);
        fibre.curl = bend * point(std::cos(side), std::sin(side), 0);
        for (std::size_t half = 0; half < 2; ++half) {
            const LatticeEnd& end = half == 0 ? lattice.stub : lattice.piece;
            for (std::size_t n = 0; n < kHalfNodes; ++n) {
                Point at = fibre.surface;
                const double deep = fibre.length[half] * (1 - static_cast<double>(n) / (kHalfNodes - 1));
                at.z() += half == 0 ? -deep : deep;
                fibre.tied[half][n] = LatticePoint::in(lattice, end, at);
            }
            const EndFrame frame = EndFrame::of(lattice, end, lattice.particles);
            fibre.channel[half] = frame.unplaced(fibre.tied[half].back().at(lattice.particles));
        }
        fibres.push_back(fibre);
    }
    return fibres;
}

}  // namespace windfall::fracture
