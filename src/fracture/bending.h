#pragma once
// Which side of a branch tore and which was crushed, when bending broke it: beam theory of a circular
// section.
//
// Wood is linear in tension until it tears and, along the grain, weaker in compression, where it yields and
// keeps its stress (Buchanan 1990, Bending strength of lumber; Forest Products Laboratory 2010, Wood
// Handbook, ch. 5). So before the break the neutral axis moves from the centre towards the tension side.
#include <algorithm>

#include "fracture/parameters.h"

namespace windfall::fracture {

/// The stressed section at the moment when the outermost fibre tears. Lengths in radii; y runs from the
/// centre towards the tension side. Stresses and moment in units of the compression strength (times radius
/// cubed).
struct SectionAtBreak {
    double neutral_axis = 0;  ///< y where the stress is zero; 0 for an elastic section
    double yield_line = -1;   ///< y below which the wood is crushed; -1: none is
    double curvature = 1;     ///< slope of the elastic part: stress = curvature (y - neutral_axis)
    double moment = 0;        ///< of the stresses about the neutral axis

    /// In units of the compression strength: tension positive, -1 where the wood yields.
    double stress(double y) const { return std::max(curvature * (y - neutral_axis), -1.0); }
};

/// Tension strength over compression strength of clear wood along the grain: 2.5 dry (published values are 2
/// to 3), 4 wet (of green wood the compression strength is about half, the tension strength little less).
double strength_ratio(Moisture moisture);

/// Solves the equilibrium of a solid circular section, plane sections, wood perfectly plastic in compression.
/// Up to a ratio of 1 the section breaks while it is elastic. `strength_ratio` > 0.
SectionAtBreak section_at_break(double strength_ratio);

/// What bending leaves for the model of the broken surface.
struct BendingBreak {
    double tension_deg = 0;         ///< direction of the tension side in the plan
    double neutral_axis = 0;        ///< offset towards the tension side, radii
    DuctileParameters ductile;      ///< the sector under tension (length and probability: as given)
    double tilt_deg = 0;            ///< of the break's plane, 0 to 45
    double tilt_direction_deg = 0;  ///< the side that stands high
};

/// From load.direction_deg, load.twist (torque over bending moment, counter-clockwise seen from the free end
/// when positive) and species.moisture. The section under tension is the segment beyond the neutral axis; its
/// sector has the segment's angle at the rim and its depth. The plane stands across the principal stress of
/// the outermost fibre, 0.5 atan(2 tau / sigma) from the section's (sigma from `section_at_break`, tau = T r
/// / J).
BendingBreak bending_break(const FractureParameters& parameters);

/// The parameters with ductile.angle_deg, .width_deg, .depth, break.tilt_deg, .tilt_direction_deg replaced
/// and bundles.compression lowered to what crushing leaves (0.1 dry, 0.25 wet), if load.source is bending;
/// unchanged by hand. Applying it twice changes nothing more.
FractureParameters with_load(const FractureParameters& parameters);

/// Share of the bundles' amplitude over the section: `compression` on the crushed side, 1 on the torn one,
/// with a smooth step from `low` to `high` along the tension direction (cos_a, sin_a).
struct TensionField {
    float cos_a = 1, sin_a = 0;
    float low = -0.25F, high = 0.35F;  ///< radii, low < high
    float compression = 1;

    float weight(float x, float y) const {
        const float t = std::clamp((x * cos_a + y * sin_a - low) / (high - low), 0.0F, 1.0F);
        return compression + (1 - compression) * t * t * (3 - 2 * t);
    }
};

/// By hand: tension side ductile.angle_deg, bundles.compression. Bending: about the neutral axis.
TensionField tension_field(const FractureParameters& parameters);

}  // namespace windfall::fracture
