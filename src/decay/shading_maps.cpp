#include "decay/shading_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "decay/growth_noise.h"
#include "decay/shading_maps_texel.h"

namespace windfall::decay {
namespace {

constexpr std::size_t kRowsABlock = 8;
constexpr float kMapUnit = 1.0F / 65535;

/// Streams of noise of a skin, beside those of growth.
enum class SkinNoise : std::uint32_t { Blush = 101, Streaks, Mottle, Patches, Grains };

std::uint32_t skin_stream(std::uint64_t seed, SkinNoise purpose) {
    return noise_stream(seed, static_cast<GrowthNoise>(purpose));
}

std::uint16_t to_texel(float value) {
    return static_cast<std::uint16_t>(std::clamp(65535 * value + 0.5F, 0.0F, 65535.0F));
}

/// Linear light on the sRGB curve, by a table: a power for every texel would take longer than all the rest.
class SrgbTable {
  public:
    SrgbTable() {
        for (std::size_t i = 0; i < m_values.size(); ++i) {
            const double c = static_cast<double>(i) / (kSize - 1);
            const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
            m_values[i] = static_cast<std::uint16_t>(std::lround(65535 * s));
        }
    }
    std::uint16_t operator()(float linear) const {
        return m_values[static_cast<std::size_t>(
            std::clamp((kSize - 1) * linear + 0.5F, 0.0F, kSize - 1.0F))];
    }

  private:
    static constexpr int kSize = 1 << 14;
    std::array<std::uint16_t, kSize> m_values{};
};

const SrgbTable& srgb_table() {
    static const SrgbTable table;
    return table;
}

/// The colours of a fresh skin: patches or streaks of blush, and mottle.
class FreshSkin {
  public:
    FreshSkin(const RotLook& look, std::uint64_t seed)
        : m_look(look),
          m_fresh(linear_from_typed(look.fresh_colour)),
          m_blush(linear_from_typed(look.blush_colour)),
          m_blush_key(skin_stream(seed, SkinNoise::Blush)),
          m_streak_key(skin_stream(seed, SkinNoise::Streaks)),
          m_mottle_key(skin_stream(seed, SkinNoise::Mottle)) {}

    /// `place_m` from the centre of the fruit, whose axis is y.
    LinearColour colour(const Eigen::Vector3f& place_m, float radius_m) const {
        const geometry::Vec3 place = (place_m / radius_m).cast<double>();
        LinearColour colour = m_fresh;
        if (m_look.blush > 0) {
            const double around = std::max(1e-6, std::hypot(place.x(), place.z()));
            // streaks fade towards the poles, where they would meet in a star
            const double streak = std::min(1.0, 1.6 * around) *
                                  value_noise(m_streak_key, {14 * place.x() / around, 1.1 * place.y(),
                                                             14 * place.z() / around});
            const double patch =
                value_noise(m_blush_key, 1.3 * place) + 0.4 * value_noise(m_blush_key + 1, 3.1 * place);
            // the sun comes from +x
            const double sunny = 0.55 * place.x() + 0.8 * patch + 0.75 * m_look.streaks * streak;
            const double middle = 1.3 * (0.5 - m_look.blush);
            const double width = 0.45 - 0.2 * m_look.streaks;
            colour = blended(m_fresh, m_blush,
                             smooth_rise(static_cast<float>(middle - width),
                                         static_cast<float>(middle + width), static_cast<float>(sunny)));
        }
        const geometry::Vec3 mottled = (place_m.cast<double>() / m_look.mottle_scale_m).eval();
        const double mottle =
            value_noise(m_mottle_key, mottled) + 0.5 * value_noise(m_mottle_key + 1, 2.1 * mottled);
        const auto factor = static_cast<float>(std::max(0.1, 1 + 2 * m_look.mottle * mottle));
        // lighter patches are yellower
        return colour.cwiseProduct(LinearColour(std::sqrt(factor), factor, factor));
    }

  private:
    const RotLook& m_look;
    LinearColour m_fresh, m_blush;
    std::uint32_t m_blush_key, m_streak_key, m_mottle_key;
};

struct SixMaps {
    std::vector<take::FrameMap> maps;

    SixMaps(const std::string& mesh, int width, int height) {
        const auto add = [&](const char* name, int components, bool srgb, double low, double high) {
            take::FrameMap map;
            map.name = name;
            map.mesh = mesh;
            map.width = width;
            map.height = height;
            map.components = components;
            map.srgb = srgb;
            map.minimum = low;
            map.maximum = high;
            map.values.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                              static_cast<std::size_t>(components));
            maps.push_back(std::move(map));
        };
        add("base_color", 3, true, 0, 1);
        add("subsurface_color", 3, true, 0, 1);
        add("roughness", 1, false, 0, 1);
        add("normal", 3, false, -1, 1);
        add("displacement", 1, false, ShadingMaps::kLowestDisplacement_m,
            ShadingMaps::kHighestDisplacement_m);
        add("mold_mask", 1, false, 0, 1);
    }
    std::uint16_t* values(std::size_t map) { return maps[map].values.data(); }
};

void put_colour(std::uint16_t* values, std::size_t texel, const LinearColour& colour,
                const SrgbTable& table) {
    for (int k = 0; k < 3; ++k) values[3 * texel + static_cast<std::size_t>(k)] = table(colour[k]);
}

/// Tangent-space normals of a height field, row by row.
void fill_normals(const ShadingTexels& texels, const std::vector<float>& heights_m, std::uint16_t* normals) {
    const auto width = static_cast<std::size_t>(texels.width),
               height = static_cast<std::size_t>(texels.height);
    parallel_blocks(height, kRowsABlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y)
            for (std::size_t x = 0; x < width; ++x) {
                const std::size_t i = y * width + x;
                // beyond the covered texels the field goes on flat
                const auto at = [&](std::size_t neighbour) {
                    return heights_m[texels.covered[neighbour] != 0 ? neighbour : i];
                };
                const float across = at(x + 1 < width ? i + 1 : i) - at(x > 0 ? i - 1 : i);
                const float up = at(y > 0 ? i - width : i) - at(y + 1 < height ? i + width : i);
                const float slope_u = 0.5F * across * texels.across_per_m[i];
                const float slope_v = 0.5F * up * texels.up_per_m[i];
                const float z = 1 / std::sqrt(1 + slope_u * slope_u + slope_v * slope_v);
                normals[3 * i] = to_texel(0.5F - 0.5F * slope_u * z);
                normals[3 * i + 1] = to_texel(0.5F - 0.5F * slope_v * z);
                normals[3 * i + 2] = to_texel(0.5F + 0.5F * z);
            }
    });
}

}  // namespace

ShadingMaps::ShadingMaps(const ShadingTexels& texels, const RotLook& look, std::uint64_t seed)
    : m_texels(texels),
      m_look(look),
      m_fresh(texels.places_m.size()),
      m_patches(texels.places_m.size()),
      m_grains(texels.places_m.size()) {
    const FreshSkin skin(m_look, seed);
    const std::uint32_t patches = skin_stream(seed, SkinNoise::Patches);
    const std::uint32_t grains = skin_stream(seed, SkinNoise::Grains);
    parallel_blocks(m_fresh.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const geometry::Vec3 place = texels.places_m[i].cast<double>();
            m_fresh[i] = skin.colour(texels.places_m[i] - texels.centre_m, texels.radius_m);
            const float coarse =
                value_noise(patches, place / 4e-3) + 0.5F * value_noise(patches + 1, place / 1.7e-3);
            m_patches[i] = std::clamp(1.3F * coarse, -1.0F, 1.0F);
            const float fine =
                value_noise(grains, place / 6.5e-4) + 0.7F * value_noise(grains + 1, place / 3e-4);
            m_grains[i] = std::clamp(1.2F * fine, -1.0F, 1.0F);
        }
    });
}

std::vector<take::FrameMap> ShadingMaps::make(const RawMaps& raw, const std::string& mesh) const {
    const auto width = static_cast<std::size_t>(m_texels.width),
               height = static_cast<std::size_t>(m_texels.height);
    if (const take::FrameMap* any = raw.any();
        any == nullptr || any->width != m_texels.width || any->height != m_texels.height)
        throw InputError(fmt::format("mesh '{}': the raw maps are not of {} x {} texels; make the take again",
                                     mesh, m_texels.width, m_texels.height));
    SixMaps six(mesh, m_texels.width, m_texels.height);
    std::uint16_t *base = six.values(0), *subsurface = six.values(1), *roughness = six.values(2),
                  *normals = six.values(3), *displacement = six.values(4), *mask = six.values(5);
    const SrgbTable& table = srgb_table();
    const LinearColour soaked = linear_from_typed(m_look.soaked_colour);
    const LinearColour rotten = linear_from_typed(m_look.rot_colour);
    const LinearColour old = linear_from_typed(m_look.old_rot_colour);
    const auto full_rot = static_cast<float>(1 / m_look.full_rot);
    const auto value = [](const take::FrameMap* map, std::size_t i, float without) {
        return map == nullptr ? without : kMapUnit * static_cast<float>(map->values[i]);
    };
    constexpr auto kLowest = static_cast<float>(kLowestDisplacement_m);
    constexpr auto kOverRange = static_cast<float>(1 / (kHighestDisplacement_m - kLowestDisplacement_m));

    std::vector<float> heights_m(width * height);
    parallel_blocks(height, kRowsABlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin * width; i < end * width; ++i) {
            ShadedPoint point;
            point.base = m_fresh[i];
            point.subsurface = blended(m_fresh[i], LinearColour(0.9F, 0.3F, 0.08F), 0.3F);
            point.roughness = static_cast<float>(m_look.roughness) + 0.04F * m_patches[i];
            const float patch = m_patches[i], grain = m_grains[i];
            const float rot = full_rot * value(raw.soft_rot, i, 0);
            if (rot > 0)
                add_rot(point, rot, 1 - value(raw.nutrient, i, 1), patch, grain, soaked, rotten, old);
            for (const RawMaps::Fungus& fungus : raw.fungi)
                if (const float density = value(fungus.density, i, 0); density > 0)
                    add_mold(point, density, value(fungus.active, i, 0), patch, grain, fungus.look);
            put_colour(base, i, point.base, table);
            put_colour(subsurface, i, point.subsurface, table);
            roughness[i] = to_texel(point.roughness);
            heights_m[i] = point.displacement_m;
            displacement[i] = to_texel((point.displacement_m - kLowest) * kOverRange);
            mask[i] = to_texel(point.mold);
        }
    });
    fill_normals(m_texels, heights_m, normals);
    return std::move(six.maps);
}

}  // namespace windfall::decay
