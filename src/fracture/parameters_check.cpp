#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "fracture/parameters.h"
#include "fracture/parameters_colours.h"

namespace windfall::fracture {

namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;
constexpr double kHighest = 250;  // radii; beyond that single precision would show steps

void check_tissues(const TissueParameters& tissue) {
    const double sum = tissue.pith + tissue.heartwood + tissue.phloem;
    // Shares such as 0.05 + 0.85 + 0.1 may miss 1 by the last bit.
    if (sum > 1 + 1e-9)
        throw InputError(fmt::format(
            "tissue.pith, tissue.heartwood and tissue.phloem take {:.4g} of the radius together: lower one "
            "of them until the sum is at most 1 (sapwood takes what is left)",
            sum));
}

void check_bundles(const BundleParameters& bundles) {
    constexpr std::size_t kMostLevels = 6;
    const std::size_t levels = bundles.radial.size();
    if (bundles.angular.size() != levels || bundles.amplitude.size() != levels ||
        bundles.slope.size() != levels)
        throw InputError(fmt::format(
            "bundles.radial, bundles.angular, bundles.amplitude and bundles.slope have {}, {}, {} and {} "
            "entries: give each of them one entry a level, or make all empty for a break without bundles",
            levels, bundles.angular.size(), bundles.amplitude.size(), bundles.slope.size()));
    if (levels > kMostLevels)
        throw InputError(fmt::format(
            "bundles.radial, bundles.angular, bundles.amplitude and bundles.slope have {} levels: leave out "
            "some, at most {} are possible",
            levels, kMostLevels));
}

struct Contribution {
    const char* keys = "";
    double height = 0;
};

/// How high the broken surface may become, in radii, by what makes it.
std::vector<Contribution> possible_heights(const FractureParameters& p) {
    double bundles = std::abs(p.bundles.bark_offset) + p.bundles.bark_amplitude;
    for (std::size_t i = 0; i < p.bundles.amplitude.size(); ++i)
        bundles +=
            p.bundles.amplitude[i] + p.bundles.slope[i] * std::max(p.bundles.radial[i], p.bundles.angular[i]);
    if (p.bundles.amplitude.empty()) bundles = 0;
    // The longest strip of bark, as bark_strips draws them.
    const double strips = p.fringe.strips > 0 ? 1.4 * p.fringe.strip_length : 0;
    const auto thorn = [](double length, double probability) { return probability > 0 ? length : 0; };
    return {
        {"break.tilt_deg", 2 * std::tan(p.fracture.tilt_deg * kRadiansPerDegree)},
        {"high.height and low.height", p.high.height - p.low.height},
        {"roughness.phloem, roughness.sapwood and roughness.heartwood",
         4 * std::max({p.roughness.phloem, p.roughness.sapwood, p.roughness.heartwood})},
        {"thorns.*_length, ductile.length and fringe.strand_length",
         std::max({thorn(p.thorns.pith_length, p.thorns.pith_probability),
                   thorn(p.thorns.heartwood_length, p.thorns.heartwood_probability),
                   thorn(p.thorns.sapwood_length, p.thorns.sapwood_probability),
                   thorn(p.thorns.phloem_length, p.thorns.phloem_probability),
                   thorn(p.ductile.length, p.ductile.probability),
                   thorn(p.fringe.strand_length, static_cast<double>(p.fringe.strands))})},
        {"bundles.amplitude and bundles.slope", bundles},
        {"fringe.strip_length", strips},
    };
}

/// The height that the broken surface stays below; throws when that is absurd. Of a surface that is scaled
/// nothing is known but its thorns; check_heights tells the rest.
double checked_height(const FractureParameters& p) {
    if (p.fracture.end == EndKind::Cut) return 0;
    const std::vector<Contribution> contributions = possible_heights(p);
    double sum = 0;
    for (const Contribution& contribution : contributions) sum += contribution.height;
    const auto largest = std::max_element(contributions.begin(), contributions.end(),
                                          [](const auto& a, const auto& b) { return a.height < b.height; });
    if (sum > kHighest)
        throw InputError(
            fmt::format("the break could become {:.4g} radii high, and {} are the most possible: lower {} "
                        "({:.4g} radii of it)",
                        sum, kHighest, largest->keys, largest->height));
    return p.fracture.height_from == HeightSource::Amplitudes ? sum : 0;
}

/// `above` and `below`: how far the break reaches up and down from its middle. The thin end must not vanish,
/// the inner side of a bend not run backwards, and the branch not meet itself.
void check_limb(const BranchParameters& branch, double above, double below) {
    constexpr double kThinnest = 0.05;  // radii
    const double upwards = branch.piece_length + above, downwards = branch.length + below;
    if (1 - branch.taper * upwards < kThinnest)
        throw InputError(fmt::format(
            "branch.taper {:.4g} leaves nothing of the branch {:.4g} radii above the break: set branch.taper "
            "to at most {:.4f}, a smaller branch.piece_length or a lower break (break.mean_height)",
            branch.taper, upwards, (1 - kThinnest) / upwards));
    constexpr double kTightest = 1.5;  // radius of the bend over that of the branch
    const double length = branch.length + branch.piece_length;
    const double widest = 1 + branch.taper * downwards;
    const double most =
        std::min(length / (kTightest * widest), std::numbers::pi * length / std::max(upwards, downwards)) /
        kRadiansPerDegree;
    if (std::abs(branch.bend_deg) > most)
        throw InputError(
            fmt::format("branch.bend_deg {} is too much for branch.length + branch.piece_length = {} radii, "
                        "it would fold "
                        "or meet itself: bend it by at most {:.0f} degrees, or make it longer",
                        branch.bend_deg, length, std::floor(most)));
}

/// Edges of the mesh are straight: over a tall break, or in rows that are far apart, they would leave a bent
/// branch. `height` of the break.
void check_chords(const BranchParameters& branch, double height) {
    // Of an edge from its arc, radii: of a wall of the broken surface, of a row of the bark.
    constexpr double kMostOff = 1, kMostOffRow = 0.5;
    const double curvature =
        std::abs(branch.bend_deg) * kRadiansPerDegree / (branch.length + branch.piece_length);
    const double left = 1 - 1 / static_cast<double>(std::max<std::int64_t>(2, branch.layers) - 1);
    const double row = (std::max(branch.length, branch.piece_length) + height) * (1 - left * left);
    if (curvature * height * height / 8 > kMostOff)
        throw InputError(fmt::format(
            "branch.bend_deg {} is too much for a break that is {:.4g} radii high: bend it by at most {:.2g} "
            "degrees, lower the break or make the branch longer",
            branch.bend_deg, height,
            std::abs(branch.bend_deg) * 8 * kMostOff / (curvature * height * height)));
    if (curvature * row * row / 8 > kMostOffRow)
        throw InputError(fmt::format(
            "branch.layers {} are too few for branch.bend_deg {}: rows of the bark would be {:.3g} "
            "radii apart; set branch.layers = {:.0f} or more, or bend it less",
            branch.layers, branch.bend_deg, row,
            std::ceil(1 + 2 * (std::max(branch.length, branch.piece_length) + height) /
                              std::sqrt(8 * kMostOffRow / curvature))));
}

}  // namespace

void check(const FractureParameters& parameters) {
    check_tissues(parameters.tissue);
    check_bundles(parameters.bundles);
    const double height = checked_height(parameters);
    check_limb(parameters.branch, height, height);
    check_colours(parameters);
    if (parameters.output.motion == Motion::Breaking && parameters.fracture.end == EndKind::Cut)
        throw InputError(
            "output.motion = \"breaking\" needs a broken branch: set break.end = \"broken\", or "
            "output.motion = \"still\" for the sawn log");
}

void check_heights(const FractureParameters& parameters, double lowest, double highest) {
    constexpr double kRoom = 0.02;  // radii, for the rim between bark and broken surface
    if (highest - lowest > kHighest)
        throw InputError(fmt::format(
            "the break is {:.4g} radii high, and {} are the most possible: lower break.mean_height, or what "
            "makes few places stand out (high.height, thorns, bundles.amplitude, bundles.skew)",
            highest - lowest, kHighest));
    check_limb(parameters.branch, highest + kRoom, kRoom - lowest);
    check_chords(parameters.branch, highest - lowest);
}

}  // namespace windfall::fracture
