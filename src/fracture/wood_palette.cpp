// Colours by eye from seasoned samples and photographs; the usual shares of tissues in branches of some
// centimetres.
#include "fracture/wood_palette.h"

#include <array>
#include <stdexcept>

namespace windfall::fracture {
namespace {

using Eigen::Vector3f;

// In the order of WoodKind, from Plain on.
const std::array<WoodPalette, 8>& palettes() {
    static const std::array<WoodPalette, 8> table{{
        // plain
        {.pith = {0.62F, 0.50F, 0.37F},
         .heartwood = {0.78F, 0.64F, 0.47F},
         .sapwood = {0.88F, 0.78F, 0.62F},
         .inner_bark = {0.60F, 0.46F, 0.33F},
         .bark = {0.50F, 0.43F, 0.37F},
         .rings = RingKind::DiffusePorous,
         .ring_width = 0.13F,
         .late_wood = 0.20F,
         .rays = 0.06F,
         .variation = 0.14F,
         .streaks = 0.14F,
         .tissue = {.pith = 0.05, .heartwood = 0.45, .phloem = 0.08}},
        // Juniperus: red heart, cream sapwood, stringy red-brown bark
        {.pith = {0.52F, 0.34F, 0.26F},
         .heartwood = {0.70F, 0.46F, 0.35F},
         .sapwood = {0.91F, 0.82F, 0.67F},
         .inner_bark = {0.61F, 0.44F, 0.33F},
         .bark = {0.53F, 0.42F, 0.34F},
         .rings = RingKind::LateWood,
         .ring_width = 0.11F,
         .late_wood = 0.28F,
         .rays = 0,
         .variation = 0.16F,
         .streaks = 0.18F,
         .tissue = {.pith = 0.03, .heartwood = 0.55, .phloem = 0.06}},
        // Juniperus chinensis
        {.pith = {0.54F, 0.37F, 0.27F},
         .heartwood = {0.74F, 0.53F, 0.40F},
         .sapwood = {0.92F, 0.84F, 0.69F},
         .inner_bark = {0.62F, 0.47F, 0.34F},
         .bark = {0.52F, 0.44F, 0.38F},
         .rings = RingKind::LateWood,
         .ring_width = 0.08F,
         .late_wood = 0.26F,
         .rays = 0,
         .variation = 0.15F,
         .streaks = 0.16F,
         .tissue = {.pith = 0.03, .heartwood = 0.50, .phloem = 0.06}},
        // Ailanthus altissima: pale yellow, wide pith, wide rings
        {.pith = {0.70F, 0.58F, 0.44F},
         .heartwood = {0.82F, 0.70F, 0.53F},
         .sapwood = {0.86F, 0.75F, 0.58F},
         .inner_bark = {0.61F, 0.49F, 0.35F},
         .bark = {0.53F, 0.48F, 0.43F},
         .rings = RingKind::RingPorous,
         .ring_width = 0.22F,
         .late_wood = 0.22F,
         .rays = 0.08F,
         .variation = 0.14F,
         .streaks = 0.14F,
         .tissue = {.pith = 0.09, .heartwood = 0.25, .phloem = 0.07}},
        // Koelreuteria paniculata: dense, brown heart, yellowish sapwood
        {.pith = {0.50F, 0.36F, 0.26F},
         .heartwood = {0.63F, 0.45F, 0.32F},
         .sapwood = {0.86F, 0.75F, 0.57F},
         .inner_bark = {0.58F, 0.42F, 0.30F},
         .bark = {0.48F, 0.42F, 0.37F},
         .rings = RingKind::RingPorous,
         .ring_width = 0.12F,
         .late_wood = 0.26F,
         .rays = 0.08F,
         .variation = 0.15F,
         .streaks = 0.15F,
         .tissue = {.pith = 0.04, .heartwood = 0.45, .phloem = 0.07}},
        // oak: grey-brown, broad bright rays
        {.pith = {0.49F, 0.38F, 0.27F},
         .heartwood = {0.68F, 0.55F, 0.41F},
         .sapwood = {0.83F, 0.73F, 0.58F},
         .inner_bark = {0.54F, 0.43F, 0.32F},
         .bark = {0.46F, 0.42F, 0.38F},
         .rings = RingKind::RingPorous,
         .ring_width = 0.067F,
         .late_wood = 0.36F,
         .rays = 0.28F,
         .variation = 0.10F,
         .streaks = 0.14F,
         .tissue = {.pith = 0.025, .heartwood = 0.69, .phloem = 0.07}},
        // pine: orange heart, strong late wood, reddish bark
        {.pith = {0.54F, 0.40F, 0.28F},
         .heartwood = {0.77F, 0.61F, 0.42F},
         .sapwood = {0.91F, 0.80F, 0.64F},
         .inner_bark = {0.68F, 0.53F, 0.37F},
         .bark = {0.53F, 0.40F, 0.32F},
         .rings = RingKind::LateWood,
         .ring_width = 0.077F,
         .late_wood = 0.42F,
         .rays = 0,
         .variation = 0.12F,
         .streaks = 0.14F,
         .tissue = {.pith = 0.025, .heartwood = 0.47, .phloem = 0.08}},
        // a green shoot: white wood, wide pith, green under the bark
        {.pith = {0.80F, 0.74F, 0.60F},
         .heartwood = {0.90F, 0.85F, 0.70F},
         .sapwood = {0.93F, 0.89F, 0.76F},
         .inner_bark = {0.64F, 0.66F, 0.45F},
         .bark = {0.50F, 0.43F, 0.36F},
         .rings = RingKind::DiffusePorous,
         .ring_width = 0.40F,
         .late_wood = 0.12F,
         .rays = 0.04F,
         .variation = 0.12F,
         .streaks = 0.14F,
         .tissue = {.pith = 0.07, .heartwood = 0, .phloem = 0.11}},
    }};
    return table;
}

void set_own(Vector3f& colour, const std::vector<double>& own) {
    if (own.size() == 3)
        colour = Vector3f(static_cast<float>(own[0]), static_cast<float>(own[1]), static_cast<float>(own[2]));
}

}  // namespace

const WoodPalette& wood_palette(WoodKind wood) {
    if (wood == WoodKind::Species) throw std::logic_error("the species' wood has no palette of its own");
    return palettes()[static_cast<std::size_t>(wood) - 1];
}

WoodKind wood_of(const FractureParameters& parameters) {
    if (parameters.colours.wood != WoodKind::Species) return parameters.colours.wood;
    switch (parameters.species.name) {
        case SpeciesName::Custom:
            return WoodKind::Plain;
        case SpeciesName::Juniperus:
            return WoodKind::Juniperus;
        case SpeciesName::JuniperusChinensis:
            return WoodKind::JuniperusChinensis;
        case SpeciesName::Ailanthus:
            return WoodKind::Ailanthus;
        case SpeciesName::Koelreuteria:
            return WoodKind::Koelreuteria;
    }
    return WoodKind::Plain;
}

WoodPalette palette_of(const FractureParameters& parameters) {
    const WoodColours& own = parameters.colours;
    WoodPalette palette = wood_palette(wood_of(parameters));
    set_own(palette.pith, own.pith);
    set_own(palette.heartwood, own.heartwood);
    set_own(palette.sapwood, own.sapwood);
    set_own(palette.inner_bark, own.inner_bark);
    set_own(palette.bark, own.bark);
    if (own.ring_width > 0) palette.ring_width = static_cast<float>(own.ring_width);
    palette.late_wood = std::min(0.9F, palette.late_wood * static_cast<float>(own.late_wood));
    palette.variation *= static_cast<float>(own.variation);
    palette.streaks *= static_cast<float>(own.streaks);
    palette.tissue = parameters.tissue;
    return palette;
}

}  // namespace windfall::fracture
