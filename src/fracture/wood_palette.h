#pragma once
// Colours and proportions of kinds of wood.
#include <Eigen/Core>

#include "fracture/parameters.h"

namespace windfall::fracture {

/// What shows the annual rings.
enum class RingKind {
    LateWood,      ///< conifers: a dark line where growth ends
    RingPorous,    ///< oak, ailanthus: wide pores where growth begins
    DiffusePorous  ///< pores all over; faint lines
};

struct WoodPalette {
    Eigen::Vector3f pith, heartwood, sapwood, inner_bark, bark;  ///< sRGB
    RingKind rings = RingKind::LateWood;
    float ring_width = 0.1F;  ///< in radii
    float late_wood = 0.4F;   ///< share of the light that late wood, or the pores, take away
    float rays = 0;           ///< brightness of the rays
    float variation = 0.15F;  ///< relative, of brightness between fibre bundles
    float streaks = 0.15F;    ///< relative, of brightness across the fibres
    TissueParameters tissue;  ///< shares of the radius, as they are usual for branches and small stems
};

/// `wood` must not be WoodKind::Species; see `wood_of`.
const WoodPalette& wood_palette(WoodKind wood);

/// Whose wood the branch looks like: colours.wood, or that of its species. Never WoodKind::Species.
WoodKind wood_of(const FractureParameters& parameters);

/// The palette of `wood_of`, with what the artist has set in its place.
WoodPalette palette_of(const FractureParameters& parameters);

}  // namespace windfall::fracture
