#include "export/glb.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "core/error.h"
#include "core/version.h"
#include "export/glb_curves.h"
#include "export/glb_part.h"

namespace windfall::export_ {
namespace {

/// The materials that faces are of, each name once.
class Materials {
  public:
    explicit Materials(std::span<const MeshToAnimate> meshes) {
        for (const auto& animated : meshes) {
            const auto used = animated.mesh.used_materials();
            for (std::size_t m = 0; m < used.size(); ++m)
                if (used[m] && find(animated.mesh.materials[m].name) == m_materials.size())
                    m_materials.push_back(animated.mesh.materials[m]);
        }
        std::vector<std::array<double, 3>> brightest(m_materials.size(), {0, 0, 0});
        for (const auto& animated : meshes) add_brightest(animated.mesh, brightest);
        // Colours at the vertices are parts of the base colour, so that a reader that knows of none shows a
        // colour of that kind.
        for (std::size_t m = 0; m < m_materials.size(); ++m)
            if (*std::max_element(brightest[m].begin(), brightest[m].end()) > 0)
                for (std::size_t k = 0; k < 3; ++k)
                    m_materials[m].base_colour[k] = std::clamp(brightest[m][k], 1e-3, 1.0);
    }

    std::size_t find(const std::string& name) const {
        const auto at = std::find_if(m_materials.begin(), m_materials.end(),
                                     [&](const auto& material) { return material.name == name; });
        return static_cast<std::size_t>(at - m_materials.begin());
    }
    const std::vector<ExportMaterial>& all() const { return m_materials; }

  private:
    void add_brightest(const MeshToExport& mesh, std::vector<std::array<double, 3>>& brightest) const {
        const take::Attribute* colour = mesh.colour();
        if (colour == nullptr) return;
        for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
            auto& most = brightest[find(mesh.materials[mesh.material_of(f)].name)];
            for (int c = 0; c < geometry::corner_count(mesh.faces[f]); ++c)
                for (std::size_t k = 0; k < 3; ++k)
                    most[k] = std::max<double>(
                        most[k], colour->values[3 * static_cast<std::size_t>(mesh.faces[f][c]) + k]);
        }
    }

    std::vector<ExportMaterial> m_materials;
};

tinygltf::Material gltf_material(const ExportMaterial& material) {
    tinygltf::Material result;
    result.name = material.name;
    const auto& colour = material.base_colour;
    result.pbrMetallicRoughness.baseColorFactor = {colour[0], colour[1], colour[2], 1};
    result.pbrMetallicRoughness.metallicFactor = 0;
    result.pbrMetallicRoughness.roughnessFactor = material.roughness;
    return result;
}

/// The parts of a mesh that have a face; a mesh of one material is one part.
std::vector<GlbPart> add_parts(BufferBuilder& buffer, const MeshToAnimate& animated,
                               const Materials& materials) {
    const MeshToExport& mesh = animated.mesh;
    const std::vector<bool> used = mesh.used_materials();
    std::vector<GlbPart> parts;
    for (std::size_t m = 0; m < mesh.materials.size(); ++m) {
        if (!used[m]) continue;
        const auto normals = !mesh.materials[m].hard         ? NormalsOfPart::OfVertices
                             : animated.later_frames.empty() ? NormalsOfPart::OfFaces
                                                             : NormalsOfPart::None;
        const std::size_t material = materials.find(mesh.materials[m].name);
        parts.push_back(add_part(buffer, mesh, m, materials.all()[material].base_colour, normals));
        parts.back().primitive.material = static_cast<int>(material);
    }
    return parts;
}

tinygltf::Mesh gltf_mesh(BufferBuilder& buffer, const MeshToAnimate& animated, const Materials& materials) {
    tinygltf::Mesh result;
    result.name = animated.mesh.name;
    std::vector<GlbPart> parts = add_parts(buffer, animated, materials);
    if (!animated.later_frames.empty()) {
        tinygltf::Value::Array names;
        for (std::size_t t = 0; t < animated.later_frames.size(); ++t) {
            for (GlbPart& part : parts) add_target(buffer, part, animated.mesh, animated.later_frames[t]);
            names.emplace_back(fmt::format("frame_{:04}", t + 1));
        }
        result.weights.assign(animated.later_frames.size(), 0.0);
        // Not in the standard, but read by Blender and three.js, and written by both.
        result.extras =
            tinygltf::Value(tinygltf::Value::Object{{"targetNames", tinygltf::Value(std::move(names))}});
    }
    for (GlbPart& part : parts) result.primitives.push_back(std::move(part.primitive));
    return result;
}

// Key k of the animation shows frame k alone: target k - 1 with weight 1, and none at key 0. All meshes
// follow the same keys.
void add_animation(tinygltf::Model& model, BufferBuilder& buffer, std::size_t targets,
                   double frames_per_second) {
    std::vector<float> times, weights;
    for (std::size_t key = 0; key <= targets; ++key) {
        times.push_back(static_cast<float>(static_cast<double>(key) / frames_per_second));
        for (std::size_t t = 0; t < targets; ++t) weights.push_back(t + 1 == key ? 1.0f : 0.0f);
    }
    tinygltf::AnimationSampler sampler;
    sampler.input = buffer.add_floats(times, TINYGLTF_TYPE_SCALAR, 0);
    set_bounds(buffer.accessor(sampler.input), times, 1);
    sampler.output = buffer.add_floats(weights, TINYGLTF_TYPE_SCALAR, 0);
    sampler.interpolation = "LINEAR";
    tinygltf::Animation animation;
    animation.name = "ageing";
    animation.samplers.push_back(std::move(sampler));
    for (std::size_t node = 0; node < model.nodes.size(); ++node) {
        tinygltf::AnimationChannel channel;
        channel.sampler = 0;
        channel.target_node = static_cast<int>(node);
        channel.target_path = "weights";
        animation.channels.push_back(std::move(channel));
    }
    model.animations.push_back(std::move(animation));
}

void add_node(tinygltf::Model& model, tinygltf::Scene& scene, tinygltf::Mesh mesh) {
    tinygltf::Node node;
    node.name = mesh.name;
    node.mesh = static_cast<int>(model.meshes.size());
    model.meshes.push_back(std::move(mesh));
    scene.nodes.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(std::move(node));
}

}  // namespace

std::vector<std::byte> glb_bytes(std::span<const MeshToAnimate> meshes, double frames_per_second,
                                 std::span<const CurvesToExport> curves) {
    const Materials materials(meshes);
    tinygltf::Model model;
    BufferBuilder buffer(model);
    tinygltf::Scene scene;
    for (const MeshToAnimate& animated : meshes)
        add_node(model, scene, gltf_mesh(buffer, animated, materials));
    if (const std::size_t targets = meshes.front().later_frames.size(); targets > 0)
        add_animation(model, buffer, targets, frames_per_second);
    for (const CurvesToExport& hair : curves)
        if (!hair.points.empty()) add_node(model, scene, gltf_curves(buffer, hair));
    for (const ExportMaterial& material : materials.all()) model.materials.push_back(gltf_material(material));
    model.scenes.push_back(std::move(scene));
    model.defaultScene = 0;
    model.asset.version = "2.0";
    model.asset.generator = "Windfall " + program_version();

    std::ostringstream stream;
    if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true))
        throw RunError("the GLB file could not be put together");
    const std::string text = std::move(stream).str();
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

}  // namespace windfall::export_
