#include "decay/dressing.h"

#include <optional>

#include "decay/shading_maps.h"

namespace windfall::decay {
namespace {

DressingSettings settings_of(const take::TakeInfo& info) {
    DressingSettings settings;
    settings.look = rot_look_from_json(info.look);
    settings.seed = info.seed;
    return settings;
}

const take::FrameMesh* moved_mesh(const take::Frame& frame, const std::string& name) {
    for (const auto& mesh : frame.meshes)
        if (mesh.name == name) return &mesh;
    return nullptr;
}

bool has_curves(const take::Frame& frame, const std::string& mesh) {
    for (const auto& curves : frame.curves)
        if (curves.mesh == mesh) return true;
    return false;
}

}  // namespace

/// What is worked out once for a mesh.
struct Dressing::Skin {
    take::TakeMesh mesh;
    std::unique_ptr<MoldHair> hair;
    std::unique_ptr<ShadingTexels> texels;  // of the size of the maps of the last frame
    std::unique_ptr<ShadingMaps> shading;

    explicit Skin(const take::TakeMesh& skin) : mesh(skin) {}

    std::vector<take::FrameMap> shading_maps(const RawMaps& raw, const DressingSettings& settings,
                                             double unit_length_m) {
        const int width = raw.any()->width, height = raw.any()->height;
        if (!texels || texels->width != width || texels->height != height) {
            texels = std::make_unique<ShadingTexels>(mesh, unit_length_m, width, height);
            shading = std::make_unique<ShadingMaps>(*texels, settings.look, settings.seed);
        }
        return shading->make(raw, mesh.name);
    }
};

Dressing::Dressing(const std::vector<take::TakeMesh>& meshes, double unit_length_m,
                   const DressingSettings& settings)
    : m_settings(settings), m_unit_length_m(unit_length_m) {
    for (const auto& mesh : meshes)
        if (!mesh.rest.corner_uvs.empty()) m_skins.push_back(std::make_unique<Skin>(mesh));
}

Dressing::Dressing(const std::vector<take::TakeMesh>& meshes, const take::TakeInfo& info)
    : Dressing(meshes, info.unit_length_m, settings_of(info)) {}

Dressing::~Dressing() = default;

void Dressing::dress(take::Frame& frame) {
    for (const auto& skin : m_skins) {
        const std::string& name = skin->mesh.name;
        const RawMaps raw(frame, name, m_settings.look);
        const take::FrameMesh* moved = moved_mesh(frame, name);
        if (raw.any() == nullptr || moved == nullptr) continue;
        std::vector<take::FrameMap> maps;
        if (m_settings.shading_maps && frame.find_map(name, "base_color") == nullptr)
            maps = skin->shading_maps(raw, m_settings, m_unit_length_m);
        if (m_settings.strands > 0 && !has_curves(frame, name)) {
            if (!skin->hair)
                skin->hair = std::make_unique<MoldHair>(
                    skin->mesh, m_unit_length_m, MoldHairSettings{m_settings.strands, m_settings.seed});
            for (auto& curves : skin->hair->grow(raw, *moved)) frame.curves.push_back(std::move(curves));
        }
        // last, since they move the maps that `raw` points to
        for (auto& map : maps) frame.maps.push_back(std::move(map));
    }
}

}  // namespace windfall::decay
