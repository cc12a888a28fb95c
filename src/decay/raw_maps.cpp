#include "decay/raw_maps.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/parallel.h"

namespace windfall::decay {
namespace {

constexpr std::size_t kTexelBlock = std::size_t{1} << 15U;
// Below this density the active share says nothing.
constexpr float kSomeDensity = 1e-3F;

using ValueOf = std::function<void(std::size_t begin, std::size_t end, float* values)>;

/// Where maps go: the atlas itself or an artist's texture.
struct Texture {
    const geometry::CubeAtlas& atlas;
    const geometry::AtlasBake* bake;
    int size;
};

take::FrameMap map_of(const Texture& texture, const std::string& mesh, const std::string& name,
                      const ValueOf& fill) {
    const geometry::CubeAtlas& atlas = texture.atlas;
    std::vector<float> values(atlas.texel_count());
    parallel_blocks(values.size(), kTexelBlock,
                    [&](std::size_t begin, std::size_t end) { fill(begin, end, values.data() + begin); });
    atlas.bleed(values);
    if (texture.bake != nullptr) {
        const auto size = static_cast<std::size_t>(texture.size);
        std::vector<float> baked(size * size, 0);
        texture.bake->bake(values, baked);
        values = std::move(baked);
    }
    take::FrameMap map;
    map.name = name;
    map.mesh = mesh;
    map.width = map.height = texture.size;
    map.values.resize(values.size());
    parallel_blocks(values.size(), kTexelBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const float rounded = std::clamp(values[i], 0.0F, 1.0F) * 65535 + 0.5F;
            map.values[i] = static_cast<std::uint16_t>(rounded);
        }
    });
    return map;
}

}  // namespace

std::vector<take::FrameMap> raw_maps(const geometry::CubeAtlas& atlas, const Growth& growth,
                                     const std::string& mesh, const geometry::AtlasBake* bake,
                                     int baked_size) {
    const Texture texture{atlas, bake, bake != nullptr ? baked_size : atlas.side()};
    std::vector<take::FrameMap> maps;
    const auto nutrient = growth.nutrient();
    maps.push_back(map_of(texture, mesh, "nutrient", [&](std::size_t begin, std::size_t end, float* values) {
        std::copy(nutrient.begin() + static_cast<std::ptrdiff_t>(begin),
                  nutrient.begin() + static_cast<std::ptrdiff_t>(end), values);
    }));
    std::size_t fungi = 0;
    for (std::size_t o = 0; o < growth.organism_count(); ++o)
        if (growth.organism(o).species.kind == OrganismKind::Fungus) ++fungi;
    for (std::size_t o = 0; o < growth.organism_count(); ++o) {
        const auto active = growth.active(o), inactive = growth.inactive(o);
        const Species& species = growth.organism(o).species;
        const bool fungus = species.kind == OrganismKind::Fungus;
        std::string suffix;
        if (fungus && fungi > 1) suffix.append("_").append(species.name.substr(species.name.rfind('-') + 1));
        maps.push_back(map_of(texture, mesh, fungus ? "fungus" + suffix : "soft_rot",
                              [&](std::size_t begin, std::size_t end, float* values) {
                                  for (std::size_t i = begin; i < end; ++i)
                                      *values++ = active[i] + inactive[i];
                              }));
        if (!fungus) continue;
        maps.push_back(map_of(texture, mesh, "fungus_active" + suffix,
                              [&](std::size_t begin, std::size_t end, float* values) {
                                  for (std::size_t i = begin; i < end; ++i) {
                                      const float all = active[i] + inactive[i];
                                      *values++ = all > kSomeDensity ? active[i] / all : 0;
                                  }
                              }));
    }
    return maps;
}

}  // namespace windfall::decay
