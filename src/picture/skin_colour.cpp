#include "picture/skin_colour.h"

#include <algorithm>

#include "core/parallel.h"
#include "picture/image.h"
#include "picture/mottle.h"

namespace windfall::picture {
namespace {

constexpr std::uint64_t kMottleSeed = 1;
constexpr std::uint64_t kBloomSeed = 11;
constexpr std::uint64_t kHueSeed = 21;
constexpr std::uint64_t kGrainSeed = 31;

float smooth_step(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
    return t * t * (3 - 2 * t);
}

Vec3f mixed(const Vec3f& a, const Vec3f& b, float t) { return (1 - t) * a + t * b; }

}  // namespace

Vec3f linear_colour(const std::vector<double>& srgb) {
    return {linear_from_srgb(static_cast<float>(srgb.at(0))),
            linear_from_srgb(static_cast<float>(srgb.at(1))),
            linear_from_srgb(static_cast<float>(srgb.at(2)))};
}

std::vector<Vec3f> skin_colours(const Look& look, const std::vector<SkinPoint>& points) {
    const Vec3f fresh_colour = linear_colour(look.fresh_colour);
    const Vec3f dry_colour = linear_colour(look.dry_colour);
    const Vec3f valley_colour = linear_colour(look.valley_colour);
    const Vec3f bloom_colour = linear_colour(look.bloom_colour);
    const auto valley_depth = static_cast<float>(look.valley_depth);
    const auto patches_per_radius = static_cast<float>(1 / look.mottle_scale);

    std::vector<Vec3f> colours(points.size());
    parallel_blocks(points.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Vec3f place = patches_per_radius * points[i].fresh_place;
            const auto strength = static_cast<float>(look.mottle);
            const float patch = strength > 0 ? mottle_noise(place, kMottleSeed) : 0;
            const float hue = strength > 0 ? mottle_noise(1.7F * place, kHueSeed) : 0;
            const Vec3f base = mixed(fresh_colour, dry_colour, std::clamp(points[i].dryness, 0.0F, 1.0F));
            // lighter patches turn towards yellow, darker ones towards red
            Vec3f colour = base * std::max(0.1F, 1 + 3.0F * strength * patch);
            colour.y() *= std::max(0.1F, 1 + 2.5F * strength * hue);

            const float depth = points[i].depth / valley_depth;
            colour =
                mixed(colour, valley_colour, static_cast<float>(look.valley) * smooth_step(-0.1F, 1, depth));

            if (look.bloom > 0) {
                const float worn = 0.55F + 0.45F * smooth_noise(0.8F * place, kBloomSeed);
                const float ridge = 1 - smooth_step(-0.6F, 0.5F, depth);
                const float film = static_cast<float>(look.bloom) * (0.25F + 0.75F * ridge) * worn;
                colour = mixed(colour, bloom_colour, std::clamp(film, 0.0F, 1.0F));
            }
            colours[i] = colour.cwiseMax(0).cwiseMin(1);
        }
    });
    return colours;
}

void roughen_normals(const Look& look, const std::vector<SkinPoint>& points, std::vector<Vec3f>& normals) {
    if (look.grain <= 0) return;
    constexpr float kSteepest = 0.35F;  // slope of the unevenness at look.grain = 1
    constexpr float kStep = 0.05F;      // of the finite difference, in wave lengths
    parallel_blocks(points.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto dryness = std::clamp(static_cast<double>(points[i].dryness), 0.0, 1.0);
            const auto strength = static_cast<float>(look.grain * (0.25 + 0.75 * dryness)) * kSteepest;
            const Vec3f place = points[i].fresh_place / static_cast<float>(look.grain_scale);
            const float here = smooth_noise(place, kGrainSeed);
            Vec3f slope;
            for (int k = 0; k < 3; ++k)
                slope[k] = (smooth_noise(place + kStep * Vec3f::Unit(k), kGrainSeed) - here) / kStep;
            const Vec3f tangential = slope - slope.dot(normals[i]) * normals[i];
            normals[i] = (normals[i] - strength * tangential).normalized();
        }
    });
}

}  // namespace windfall::picture
