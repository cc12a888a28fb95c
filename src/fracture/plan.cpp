#include "fracture/plan.h"

#include <fmt/format.h>

#include "fracture/species.h"

namespace windfall::fracture {

namespace {

/// Of the surface, the bark's rows and the cut end of one end. Where bundles break at their own heights a
/// vertex of the lattice is there about twice.
std::int64_t vertices_of_an_end(const FractureParameters& p) {
    const bool walls = p.fracture.end == EndKind::Broken && !p.bundles.radial.empty();
    return (walls ? 2 : 1) * p.branch.rings * p.branch.sectors + p.branch.layers * p.branch.sectors + 2;
}

void add_lattice_warnings(const FractureParameters& p, Plan& plan) {
    if (p.fracture.end == EndKind::Cut || p.bundles.radial.empty()) return;
    const double finest = p.bundles.angular.back();
    const double spacing = 6.28 / static_cast<double>(p.branch.sectors);
    if (finest < spacing)
        plan.warnings.push_back(fmt::format(
            "the finest fibre bundles, bundles.angular {:.3g} radii, are narrower than a sector at "
            "the bark ({:.3g}) and will look torn: set branch.sectors = {:.0f} or more, or leave "
            "out a level",
            finest, spacing, 6.28 / finest + 0.5));
}

}  // namespace

Plan plan(const FractureParameters& parameters) {
    check(parameters);
    Plan result;
    const bool cut = parameters.fracture.end == EndKind::Cut;
    const bool two_ends = !cut && (parameters.output.piece != PiecePlace::Hidden ||
                                   parameters.output.motion == Motion::Breaking);
    result.vertices = (two_ends ? 2 : 1) * vertices_of_an_end(parameters);
    if (parameters.output.motion == Motion::Breaking) result.frames = parameters.output.frames;
    if (!cut) {
        const bool from_species = parameters.fracture.height_from == HeightSource::Species;
        result.law_height = asked_mean_height(parameters, from_species ? &result.warnings : nullptr);
    }
    add_lattice_warnings(parameters, result);
    return result;
}

}  // namespace windfall::fracture
