#include "picture/grain.h"

#include <algorithm>

#include "picture/solid_noise.h"

namespace windfall::picture {
namespace {

constexpr std::uint32_t kWarpSeed = 0x51ED270BU, kPlateSeed = 0x2545F491U, kFlakeSeed = 0x9D2C5680U,
                        kFibreSeed = 0x7F4A7C15U, kPoreSeed = 0x1B873593U, kPeelSeed = 0x68E31DA4U;

/// Width of the furrows between the plates of bark, of the plates' size.
constexpr float kFurrow = 0.2F;

float ramp(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
    return t * t * (3 - 2 * t);
}

/// Long plates between furrows, split into flakes along the stem.
GrainValue bark_grain(const Vec3f& rest) {
    const Vec3f plate_scale(5.0F, 0.95F, 5.0F);
    const NoiseValue warp = solid_noise(rest.cwiseProduct(Vec3f(5, 1.4F, 5)), kWarpSeed);
    // the flakes lean now this way, now that
    const NoiseValue flakes =
        fractal_noise(rest + Vec3f(0.03F, 0.12F, -0.03F) * warp.value, Vec3f(18, 2.5F, 18), 4, kFlakeSeed);
    const Vec3f bent = rest.cwiseProduct(plate_scale) + Vec3f(0.3F, 0.5F, -0.3F) * warp.value +
                       Vec3f(0.35F, -0.25F, 0.35F) * flakes.value;
    const NoiseValue plate = cell_noise(bent, kPlateSeed);
    const float t = std::clamp(plate.value / kFurrow, 0.0F, 1.0F);
    const float top = t * t * (3 - 2 * t), rising = 6 * t * (1 - t) / kFurrow;
    const float flake = 0.5F + 0.75F * flakes.value;
    const float height = flake * (0.6F + 0.4F * top);
    GrainValue result;
    result.tint = Vec3f(1, 0.985F, 0.95F) * (0.40F + 0.98F * ramp(0.24F, 0.68F, height));
    const Vec3f of_flakes = 0.75F * (0.6F + 0.4F * top) * flakes.gradient;
    const Vec3f of_plates = 0.4F * flake * rising * plate.gradient.cwiseProduct(plate_scale);
    result.slope = 0.065F * of_flakes + 0.06F * of_plates;
    return result;
}

/// Streaks along the fibres; where they are cut across, fine speckles.
GrainValue wood_grain(const Vec3f& rest, const Vec3f& scale, float dark, float light, float depth,
                      std::uint32_t seed) {
    const NoiseValue n = fractal_noise(rest, scale, 3, seed);
    GrainValue result;
    const float value = ramp(-0.36F, 0.36F, n.value);
    result.tint = Vec3f(1, 0.985F, 0.955F) * (dark + (light - dark) * value);
    result.slope = depth * n.gradient;
    return result;
}

/// Round pits, one to a cell of unit size at the most: 1 in the middle, 0 outside of them.
NoiseValue pits(const Vec3f& place, std::uint32_t seed) {
    const Vec3f whole = place.array().floor();
    const auto x = static_cast<std::int32_t>(whole.x()), y = static_cast<std::int32_t>(whole.y()),
               z = static_cast<std::int32_t>(whole.z());
    const Vec3f f = place - whole;
    NoiseValue deepest;
    for (int cell = 0; cell < 27; ++cell) {
        const int i = cell % 3 - 1, j = cell / 3 % 3 - 1, k = cell / 9 - 1;
        const std::uint32_t bits = hashed_cell(x + i, y + j, z + k, seed);
        const auto part = [&](unsigned shift) { return static_cast<float>(bits >> shift & 0xFFU) * 0x1p-8F; };
        const Vec3f from = f - Vec3f(static_cast<float>(i) + part(0), static_cast<float>(j) + part(8),
                                     static_cast<float>(k) + part(16));
        const float radius = 0.30F + 0.22F * part(24), depth = 0.5F + 0.5F * part(20);
        const float inside = 1 - from.squaredNorm() / (radius * radius);
        if (inside <= 0 || depth * inside * inside <= deepest.value) continue;
        deepest = {depth * inside * inside, -4 * depth * inside / (radius * radius) * from};
    }
    return deepest;
}

/// The pits over the oil glands of a citrus fruit, in a skin that is a little uneven between them.
GrainValue peel_grain(const Vec3f& rest) {
    const NoiseValue pit = pits(rest, kPeelSeed);
    const NoiseValue swell = solid_noise(0.4F * rest, kPeelSeed + 1);
    GrainValue result;
    result.tint = Vec3f::Ones() - pit.value * Vec3f(0.05F, 0.13F, 0.20F);
    result.slope = -0.13F * pit.gradient + 0.035F * swell.gradient;
    return result;
}

/// The gradient on the surface as it is now from that on the surface at rest: the height climbs as much along
/// an edge now as it does at rest.
Vec3f carried_slope(const SurfacePoint& point, const Vec3f& slope) {
    const SceneMesh& mesh = *point.mesh;
    const auto edge = [&](const std::vector<Vec3f>& at, std::size_t k) -> Vec3f {
        return at[point.corners[k]] - at[point.corners[0]];
    };
    const Vec3f a = edge(mesh.positions, 1), b = edge(mesh.positions, 2);
    const Vec3f area = a.cross(b);
    const float size_sq = area.squaredNorm();
    if (!(size_sq > 1e-20F)) return Vec3f::Zero();
    const float along_a = slope.dot(edge(mesh.rest, 1)), along_b = slope.dot(edge(mesh.rest, 2));
    return (along_a * b.cross(area) + along_b * area.cross(a)) / size_sq;
}

}  // namespace

GrainValue grain_at(Grain grain, const Vec3f& rest) {
    switch (grain) {
        case Grain::None:
            break;
        case Grain::Bark:
            return bark_grain(rest);
        case Grain::Fibres:
            return wood_grain(rest, Vec3f(75, 2.2F, 75), 0.64F, 1.14F, 0.006F, kFibreSeed);
        case Grain::EndGrain:
            return wood_grain(rest, Vec3f(110, 6, 110), 0.78F, 1.10F, 0.004F, kPoreSeed);
        case Grain::Peel:
            return peel_grain(rest);
    }
    return {};
}

void apply_grain(SurfacePoint& point) {
    if (point.finish->grain == Grain::None) return;
    const SceneMesh& mesh = *point.mesh;
    Vec3f rest = Vec3f::Zero();
    for (std::size_t k = 0; k < 3; ++k) rest += point.weights[k] * mesh.rest[point.corners[k]];
    GrainValue grain;
    if (point.finish->grain == Grain::Peel) {
        // a height in pores over a place in pores: the slope needs no scale
        grain = grain_at(Grain::Peel, rest / point.finish->pore_size);
        const float strength = point.pores * point.finish->pore_depth;
        grain.tint = Vec3f::Ones() + strength * (grain.tint - Vec3f::Ones());
        grain.slope *= strength;
    } else {
        grain = grain_at(point.finish->grain, rest);
    }
    point.albedo = point.albedo.cwiseProduct(grain.tint).cwiseMin(0.95F);
    const Vec3f slope = carried_slope(point, grain.slope);
    const Vec3f tangential = slope - slope.dot(point.normal) * point.normal;
    const Vec3f tilted = (point.normal - tangential).normalized();
    // tilted out of sight of its own face it would be black
    if (tilted.dot(point.face_normal) > 0.05F) point.normal = tilted;
}

}  // namespace windfall::picture
