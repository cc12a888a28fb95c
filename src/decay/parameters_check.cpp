#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "decay/growth_settings.h"
#include "decay/organisms_of.h"
#include "decay/parameters.h"
#include "decay/species.h"

namespace windfall::decay {

std::vector<std::string> fungus_names(const GrowthParameters& growth) {
    std::vector<std::string> names;
    std::string name;
    for (const char c : growth.fungi + ",") {
        if (c != ',') {
            if (c != ' ') name += c;
        } else if (!name.empty()) {
            names.push_back(name);
            name.clear();
        }
    }
    return names;
}

void check(const DecayParameters& p) {
    if (p.fruit.water_kg >= p.fruit.mass_kg)
        throw InputError(
            fmt::format("fruit.water_kg ({} kg) must be less than fruit.mass_kg ({} kg): some of a "
                        "fruit is solid",
                        p.fruit.water_kg, p.fruit.mass_kg));
    if ((p.fruit.kind == FruitKind::Mesh) == p.fruit.mesh.empty())
        throw InputError("fruit.kind = \"mesh\" and fruit.mesh = \"file\" go together: give both or neither");
    if (p.start.wounds_m.size() % 3 != 0)
        throw InputError(fmt::format("start.wounds_m has {} numbers; it takes x, y, z for each wound",
                                     p.start.wounds_m.size()));
    if (p.output.texels % 2 != 0)
        throw InputError(fmt::format("output.texels must be even, not {}", p.output.texels));
    if (p.pile.ground == PileGround::Bowl && p.pile.bowl_height_m > p.pile.bowl_radius_m)
        throw InputError("pile.bowl_height_m must not be more than pile.bowl_radius_m");
    const std::vector<std::string> fungi = fungus_names(p.growth);
    if (fungi.size() > 4)
        throw InputError(fmt::format("growth.fungi names {} species; at most 4 share a fruit", fungi.size()));
    water::climate_of(p.climate);
    decay::check(organisms_of(p), growth_settings_of(p));
    if (p.start.random == 0 && !p.start.contacts && !p.start.stem && p.start.wounds_m.empty() &&
        p.start.mask.empty())
        throw InputError(
            "nothing begins to rot: set start.random, start.contacts, start.stem, start.wounds_m or "
            "start.mask");
}

}  // namespace windfall::decay
