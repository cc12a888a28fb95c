#include <fmt/format.h>

#include "core/error.h"
#include "decay/shading_maps.h"

namespace windfall::decay {
namespace {

const take::FrameMap* raw_map(const take::Frame& frame, const std::string& mesh, const std::string& name) {
    const take::FrameMap* own = frame.find_map(mesh, name);
    return own != nullptr ? own : frame.find_map("", name);
}

}  // namespace

RawMaps::RawMaps(const take::Frame& frame, const std::string& mesh, const RotLook& look) {
    const std::string plain = "fungus", share = "fungus_active";
    soft_rot = raw_map(frame, mesh, "soft_rot");
    nutrient = raw_map(frame, mesh, "nutrient");
    for (const auto& map : frame.maps) {
        if (!map.mesh.empty() && map.mesh != mesh) continue;
        if (map.name == plain)
            fungi.push_back({&map, raw_map(frame, mesh, share), mold_look(look.species)});
        else if (map.name.starts_with(plain + "_") && !map.name.starts_with(share))
            fungi.push_back({&map, raw_map(frame, mesh, share + map.name.substr(plain.size())),
                             mold_look(map.name.substr(plain.size() + 1))});
    }
    const take::FrameMap* first = any();
    const auto check = [&](const take::FrameMap* map) {
        if (map != nullptr &&
            (map->width != first->width || map->height != first->height || map->components != 1 ||
             map->values.size() !=
                 static_cast<std::size_t>(map->width) * static_cast<std::size_t>(map->height)))
            throw InputError(
                fmt::format("frame {}: map '{}' has {} x {} texels with {} components and '{}' {} x "
                            "{}; make the take again",
                            frame.index, map->name, map->width, map->height, map->components, first->name,
                            first->width, first->height));
    };
    check(soft_rot);
    check(nutrient);
    for (const Fungus& fungus : fungi) {
        check(fungus.density);
        check(fungus.active);
    }
}

const take::FrameMap* RawMaps::any() const {
    if (soft_rot != nullptr) return soft_rot;
    if (nutrient != nullptr) return nutrient;
    return fungi.empty() ? nullptr : fungi.front().density;
}

}  // namespace windfall::decay
