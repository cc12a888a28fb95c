#pragma once
// What rot and mold make of one point of the skin. For the shading maps.
#include <algorithm>
#include <cmath>
#include <span>

#include "decay/rot_colours.h"

namespace windfall::decay {

/// Rises from 0 at `low` to 1 at `high` without a corner.
inline float smooth_rise(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
    return t * t * (3 - 2 * t);
}

inline LinearColour blended(const LinearColour& a, const LinearColour& b, float t) { return a + t * (b - a); }

/// How much of the skin a mold of this density hides, with the fixed unevenness of the place (-1 .. 1): the
/// thin edge of a mat is frayed.
inline float mold_cover(float density, float patch, float grain) {
    const float thin = std::max(0.0F, 1 - density);
    return smooth_rise(0.01F, 0.40F, density * (1 + thin * (0.4F * patch + 0.7F * grain)));
}

/// 0 where the mat is all young mycelium, 1 where it is all spores; `active` is the share of its density.
inline float mold_age(float active, float patch) {
    return smooth_rise(0.30F, 0.85F, 1 - active + 0.12F * patch);
}

/// One point of the skin as a renderer takes it.
struct ShadedPoint {
    LinearColour base, subsurface;
    float roughness = 0, displacement_m = 0, mold = 0;
};

/// Soft rot: from the margin, where the skin is soaked and glassy, to old brown rot. `rot` 0 .. 1 of what
/// there can be, `eaten` the share of the nutrient that is gone.
inline void add_rot(ShadedPoint& point, float rot, float eaten, float patch, float grain,
                    const LinearColour& soaked, const LinearColour& rotten, const LinearColour& old) {
    const float uneven = rot * (1 + 0.30F * patch + 0.10F * grain);
    const float cover = smooth_rise(0.015F, 0.30F, uneven);
    if (cover <= 0) return;
    const float firm_gone = smooth_rise(0.10F, 0.75F, uneven);
    const float age = std::clamp(0.55F * smooth_rise(0.5F, 1, uneven) + 0.6F * (eaten - 0.3F), 0.0F, 1.0F);
    const LinearColour brown = blended(rotten, old, age) * (1 + 0.22F * patch + 0.10F * grain);
    // the soaked margin lets the colour of the fresh skin through
    const LinearColour margin = blended(soaked, soaked.cwiseProduct(point.base) * 2.0F, 0.35F);
    point.base = blended(point.base, blended(margin, brown, firm_gone), cover);
    const LinearColour glow(0.62F, 0.20F, 0.06F);
    point.subsurface = blended(point.subsurface, glow, 0.7F * cover);
    const float wet = 4 * cover * (1 - cover);
    point.roughness += cover * (0.36F - 0.08F * patch - point.roughness);
    point.roughness += wet * 0.7F * (0.17F - point.roughness);
    // leathery: finer folds than the mesh has
    point.displacement_m += firm_gone * (-1.5e-4F + 2.2e-4F * patch + 0.5e-4F * grain);
}

inline void add_mold(ShadedPoint& point, float density, float active, float patch, float grain,
                     const MoldLook& look) {
    const float cover = look.thickness * mold_cover(density, patch, grain);
    if (cover <= 0) return;
    const float age = mold_age(active, patch + 0.5F * grain);
    const float spent = smooth_rise(0.93F, 1.0F, 1 - active) * smooth_rise(-0.3F, 0.5F, patch);
    LinearColour colour = blended(look.young, blended(look.mature, look.old, spent), age);
    colour *= 1 + (0.05F + 0.16F * age) * grain + 0.10F * age * patch;
    point.base = blended(point.base, colour, cover);
    point.subsurface = blended(point.subsurface, colour, cover);
    point.roughness += cover * (0.97F - point.roughness);
    // the rim is the fluffiest part, spores lie as a powder in low hummocks
    const float height = look.relief_m * (1.15F - 0.55F * age) * (1 + 0.45F * patch + 0.5F * grain);
    point.displacement_m += cover * height;
    point.mold = std::max(point.mold, cover);
}

}  // namespace windfall::decay
