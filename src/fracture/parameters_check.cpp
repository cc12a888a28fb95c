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
    const auto thorn = [](double length, double probability) { return probability > 0 ? length : 0; };
    return {
        {"break.tilt_deg", 2 * std::tan(p.fracture.tilt_deg * kRadiansPerDegree)},
        {"high.height and low.height", p.high.height - p.low.height},
        {"roughness.phloem, roughness.sapwood and roughness.heartwood",
         4 * std::max({p.roughness.phloem, p.roughness.sapwood, p.roughness.heartwood})},
        {"thorns.*_length and ductile.length",
         std::max({thorn(p.thorns.pith_length, p.thorns.pith_probability),
                   thorn(p.thorns.heartwood_length, p.thorns.heartwood_probability),
                   thorn(p.thorns.sapwood_length, p.thorns.sapwood_probability),
                   thorn(p.thorns.phloem_length, p.thorns.phloem_probability),
                   thorn(p.ductile.length, p.ductile.probability)})},
        {"bundles.amplitude and bundles.slope", bundles},
    };
}

/// The height that the broken surface stays below; throws when that is absurd.
double checked_height(const FractureParameters& p) {
    constexpr double kHighest = 250;  // radii; beyond that single precision would show steps
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
    return sum;
}

/// `height` of the break, which stands on the stub and in the piece. The thin end must not vanish, the inner
/// side of a bend not run backwards, and the branch not meet itself.
void check_limb(const BranchParameters& branch, double height) {
    constexpr double kThinnest = 0.05;  // radii
    const double upwards = branch.piece_length + height, downwards = branch.length + height;
    if (1 - branch.taper * upwards < kThinnest)
        throw InputError(fmt::format(
            "branch.taper {:.4g} leaves nothing of the branch {:.4g} radii above the break: set branch.taper "
            "to at most {:.4f}, or a smaller branch.piece_length",
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

}  // namespace

void check(const FractureParameters& parameters) {
    check_tissues(parameters.tissue);
    check_bundles(parameters.bundles);
    check_limb(parameters.branch, checked_height(parameters));
    check_colours(parameters);
    if (parameters.output.motion == Motion::Breaking && parameters.fracture.end == EndKind::Cut)
        throw InputError(
            "output.motion = \"breaking\" needs a broken branch: set break.end = \"broken\", or "
            "output.motion = \"still\" for the sawn log");
}

}  // namespace windfall::fracture
