#include "fracture/breaking_lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace windfall::fracture {

namespace {

constexpr double kGravity = 9.81;  // m/s^2
/// Particles times steps that are no matter, about a quarter of a minute of one thread. Beyond them the wood
/// is made a little softer, down to this share of the wave speed.
constexpr double kMuchWork = 3e8, kSoftest = 0.75;

/// Mean height of the broken surface about each column; a column without a vertex takes its neighbours'.
std::vector<double> column_heights(const DiscPlan& plan, const BreakEnds& ends) {
    std::vector<double> sums(plan.size(), 0.0), counts(plan.size(), 0.0);
    for (std::int32_t v = 0; v < ends.surface_vertices; ++v) {
        const Vector3f& p = ends.stub.positions[static_cast<std::size_t>(v)];
        const std::size_t column = plan.nearest(p.x(), p.y());
        sums[column] += p.z();
        counts[column] += 1;
    }
    std::vector<double> heights(plan.size());
    for (std::size_t c = 0; c < plan.size(); ++c) {
        if (counts[c] > 0) {
            heights[c] = sums[c] / counts[c];
            continue;
        }
        double weights = 0;
        for (std::size_t o = 0; o < plan.size(); ++o) {
            if (counts[o] == 0) continue;
            const double dx = plan.x(o) - plan.x(c), dy = plan.y(o) - plan.y(c);
            const double weight = 1 / std::pow(dx * dx + dy * dy, 2);
            heights[c] += weight * sums[o] / counts[o];
            weights += weight;
        }
        if (weights > 0) heights[c] /= weights;
    }
    return heights;
}

/// Discs a quarter of a radius apart about the break, farther apart towards the ends of the branch.
std::vector<double> disc_levels(double bottom, double low, double high, double top) {
    constexpr double kFinest = 0.25, kGrowth = 1.2;
    const double finest = std::max(kFinest, (high - low) / 24);
    if (high - low < finest) low = high = (low + high) / 2;
    const double coarsest = std::max({0.5, finest, (top - bottom) / 48});
    // Heights of one end from the break outwards, scaled so that the last one is its cut end.
    const auto outwards = [&](double length) {
        std::vector<double> at = {0};
        for (double next = finest; at.back() < length || at.size() < 4;
             next = std::min(next * kGrowth, coarsest))
            at.push_back(at.back() + next);
        for (double& a : at) a *= length / at.back();
        return at;
    };
    std::vector<double> levels;
    const std::vector<double> below = outwards(low - bottom), above = outwards(top - high);
    for (std::size_t i = below.size(); i-- > 0;) levels.push_back(low - below[i]);
    const int between = static_cast<int>((high - low) / finest);
    for (int i = 1; i < between; ++i) levels.push_back(low + (high - low) * i / between);
    for (double a : above)
        if (a > 0 || high - levels.back() > 1e-6) levels.push_back(high + a);
    return levels;
}

double lowest_of(const std::vector<Vector3f>& positions) {
    double z = std::numeric_limits<double>::infinity();
    for (const Vector3f& p : positions) z = std::min(z, static_cast<double>(p.z()));
    return z;
}

double highest_of(const std::vector<Vector3f>& positions) {
    double z = -std::numeric_limits<double>::infinity();
    for (const Vector3f& p : positions) z = std::max(z, static_cast<double>(p.z()));
    return z;
}

/// The wave speed, and with it the number of steps: one disc a step.
void set_clock(BreakingLattice& lattice, const FractureParameters& parameters, std::size_t particles) {
    const double radius_m = parameters.branch.diameter_m / 2;
    lattice.gravity = kGravity / radius_m;
    const double length =
        std::max(lattice.levels.back() - lattice.heights[0], lattice.heights[0] - lattice.levels.front());
    constexpr double kStiffness = 18;  // the section bears several times the piece's weight held sideways
    const double wanted = kStiffness * std::clamp(length, 4.0, 30.0) * std::sqrt(lattice.gravity);
    const double seconds = parameters.output.seconds;
    const double steps = std::ceil(seconds * wanted / lattice.spacing);
    const double few = std::max(kMuchWork / static_cast<double>(particles), kSoftest * steps);
    lattice.steps = static_cast<int>(std::max(std::min(steps, few), 1.0));
    lattice.step = seconds / lattice.steps;
    lattice.wave_speed = lattice.spacing / lattice.step;
}

}  // namespace

BreakingLattice make_breaking_lattice(const FractureParameters& parameters, const BreakEnds& ends,
                                      const RestShape& shape) {
    BreakingLattice lattice;
    lattice.heights = column_heights(lattice.plan, ends);
    const auto [low, high] = std::minmax_element(lattice.heights.begin(), lattice.heights.end());
    lattice.levels =
        disc_levels(lowest_of(ends.stub.positions), *low, *high, highest_of(ends.piece.positions));
    const int last = static_cast<int>(lattice.levels.size()) - 1;
    lattice.spacing = lattice.levels[1] - lattice.levels[0];
    for (std::size_t k = 1; k < lattice.levels.size(); ++k)
        lattice.spacing = std::min(lattice.spacing, lattice.levels[k] - lattice.levels[k - 1]);
    const auto level_at = [&](double height) {
        const auto found = std::lower_bound(lattice.levels.begin(), lattice.levels.end(), height - 1e-9);
        return static_cast<int>(found - lattice.levels.begin());
    };
    lattice.stub.first_level = 0;
    lattice.stub.last_level = std::min(level_at(*high) + 1, last - 1);
    lattice.piece.first_level = std::max(level_at(*low) - 1, 1);
    lattice.piece.last_level = last;

    const int discs = lattice.stub.last_level + 1 + last - lattice.piece.first_level + 1;
    set_clock(lattice, parameters, static_cast<std::size_t>(discs) * lattice.plan.size());
    const double modulus = lattice.wave_speed * lattice.wave_speed;
    const LatticeMaterial material = {modulus, modulus / 4, modulus / 8};
    std::vector<Spring> springs;
    // The share of a cell about a disc that lies below the broken surface. The particles next to it, which
    // the bonds hold on to, are as stiff as wood.
    const auto share_of = [](double depth) {
        return CellShare{std::clamp(depth + 0.5, 0.0, 1.0), std::clamp(depth + 1.5, 0.0, 1.0)};
    };
    const auto depth = [&lattice](int level, std::size_t column) {
        return (lattice.heights[column] - lattice.levels[static_cast<std::size_t>(level)]) / lattice.spacing;
    };
    const auto below = [&](int level, std::size_t column) { return share_of(depth(level, column)); };
    const auto above = [&](int level, std::size_t column) { return share_of(-depth(level, column)); };
    add_lattice(lattice.stub, lattice.plan, lattice.levels, material, below, shape, true, lattice.particles,
                springs);
    add_lattice(lattice.piece, lattice.plan, lattice.levels, material, above, shape, false, lattice.particles,
                springs);
    lattice.constraints = prepare(springs, lattice.particles, lattice.step);

    lattice.ground = std::numeric_limits<double>::infinity();
    std::vector<Vector3f> stub = ends.stub.positions;
    shape(stub);
    for (const Vector3f& p : stub) lattice.ground = std::min(lattice.ground, static_cast<double>(p.z()));
    for (const Point& p : lattice.particles.position) lattice.ground = std::min(lattice.ground, p.z());
    return lattice;
}

}  // namespace windfall::fracture
