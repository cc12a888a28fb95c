#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/error.h"
#include "meshfile/gltf.h"
#include "meshfile/gltf_source.h"

namespace windfall::meshfile {
namespace {

using Eigen::Affine3d;

/// Keeps an image's bytes as they are: only those of data URIs, the others stay in their buffer or file.
bool keep_image(tinygltf::Image* image, const int /*index*/, std::string* /*error*/, std::string* /*warning*/,
                int /*width*/, int /*height*/, const unsigned char* bytes, int size, void* /*user*/) {
    if (image->bufferView < 0 && image->uri.empty()) image->image.assign(bytes, bytes + size);
    image->as_is = true;
    return true;
}

void load(tinygltf::Model& model, std::span<const std::byte> bytes, const std::string& name, Format format,
          const std::string& folder) {
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keep_image, nullptr);
    std::string error, warning;
    const std::vector<unsigned char> data(
        reinterpret_cast<const unsigned char*>(bytes.data()),
        reinterpret_cast<const unsigned char*>(bytes.data()) + bytes.size());
    const auto size = static_cast<unsigned int>(data.size());
    bool loaded = false;
    try {
        if (format == Format::Glb) {
            loaded = loader.LoadBinaryFromMemory(&model, &error, &warning, data.data(), size, folder);
        } else {
            const std::string text(data.begin(), data.end());
            loaded = loader.LoadASCIIFromString(&model, &error, &warning, text.c_str(), size, folder);
        }
    } catch (const std::exception& problem) {
        error = problem.what();
    }
    while (!error.empty() && (error.back() == '\n' || error.back() == '.')) error.pop_back();
    std::replace(error.begin(), error.end(), '\n', ' ');
    if (!loaded)
        throw InputError(
            fmt::format("{}: this is no glTF file that can be read ({}); export it again as glTF 2.0", name,
                        error.empty() ? "damaged" : error));
}

/// Throws std::out_of_range unless an attribute of this name may have so many numbers a vertex (glTF 2.0,
/// 3.7.2.1).
void check_components(const std::string& name, int components) {
    int least = 1, most = 4;
    if (name == "POSITION" || name == "NORMAL") least = most = 3;
    if (name == "TANGENT") least = most = 4;
    if (name.starts_with("TEXCOORD_")) least = most = 2;
    if (name.starts_with("COLOR_")) least = 3;
    if (components < least || components > most)
        throw std::out_of_range(fmt::format("{} has {} {} a vertex instead of {}", name, components,
                                            components == 1 ? "number" : "numbers",
                                            components < least ? least : most));
}

/// The type and number of components that an attribute of this name has.
Attribute attribute_named(const std::string& name, int components) {
    Attribute attribute{name, Role::Other, components, {}, false, {}};
    if (name == "NORMAL") attribute.role = Role::Normal;
    if (name == "TANGENT") attribute.role = Role::Tangent;
    if (name.starts_with("TEXCOORD_")) attribute.role = Role::TextureCoordinate;
    if (name.starts_with("COLOR_")) attribute.role = Role::Colour;
    return attribute;
}

Affine3d transform_of(const tinygltf::Node& node) {
    Affine3d transform = Affine3d::Identity();
    if (node.matrix.size() == 16) {
        transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
        return transform;
    }
    if (node.translation.size() == 3)
        transform.translate(Vec3(node.translation[0], node.translation[1], node.translation[2]));
    if (node.rotation.size() == 4)
        transform.rotate(
            Eigen::Quaterniond(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2])
                .normalized());
    if (node.scale.size() == 3) transform.scale(Vec3(node.scale[0], node.scale[1], node.scale[2]));
    return transform;
}

/// Corners of triangles from those of a strip or fan.
std::vector<std::int32_t> triangles_of(const std::vector<std::int32_t>& indices, int mode) {
    if (mode != TINYGLTF_MODE_TRIANGLE_STRIP && mode != TINYGLTF_MODE_TRIANGLE_FAN) return indices;
    std::vector<std::int32_t> corners;
    for (std::size_t i = 2; i < indices.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
            corners.insert(corners.end(), {indices[i - 1], indices[i], indices[0]});
        else if (i % 2 == 0)
            corners.insert(corners.end(), {indices[i - 2], indices[i - 1], indices[i]});
        else
            corners.insert(corners.end(), {indices[i - 1], indices[i - 2], indices[i]});
    }
    return corners;
}

class GltfReader {
  public:
    GltfReader(const tinygltf::Model& model, const std::string& name) : m_model(model), m_name(name) {}

    Mesh take() {
        refuse_what_cannot_be_kept();
        for (std::size_t m = 0; m < m_model.materials.size(); ++m)
            m_mesh.materials.push_back({m_model.materials[m].name, static_cast<int>(m)});
        m_seen.assign(m_model.nodes.size(), false);
        for (const int root : roots()) visit(root, Affine3d::Identity(), 0);
        if (!m_model.animations.empty())
            m_mesh.warnings.emplace_back(
                "animations go on moving the tree's nodes; the fallen piece has none");
        return std::move(m_mesh);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(fmt::format("{}: {}", m_name, what));
    }

    void refuse_what_cannot_be_kept() const {
        const std::map<std::string, const char*> refused{
            {"KHR_draco_mesh_compression", "export it without Draco compression"},
            {"EXT_meshopt_compression", "export it without meshopt compression"},
            {"EXT_mesh_gpu_instancing", "make the instances real before exporting"}};
        for (const std::string& extension : m_model.extensionsUsed)
            if (const auto found = refused.find(extension); found != refused.end())
                fail(fmt::format("it uses {}; {}", extension, found->second));
    }

    std::vector<int> roots() const {
        if (!m_model.scenes.empty()) {
            const int scene = std::max(m_model.defaultScene, 0);
            if (static_cast<std::size_t>(scene) >= m_model.scenes.size())
                fail("its scene is missing; export it again");
            return m_model.scenes[static_cast<std::size_t>(scene)].nodes;
        }
        std::vector<bool> is_child(m_model.nodes.size(), false);
        for (const tinygltf::Node& node : m_model.nodes)
            for (const int child : node.children)
                if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
                    is_child[static_cast<std::size_t>(child)] = true;
        std::vector<int> result;
        for (std::size_t n = 0; n < is_child.size(); ++n)
            if (!is_child[n]) result.push_back(static_cast<int>(n));
        return result;
    }

    void visit(int index, const Affine3d& parent, int depth) {
        constexpr int kDeepest = 1000;
        if (index < 0 || static_cast<std::size_t>(index) >= m_model.nodes.size() || depth > kDeepest ||
            m_seen[static_cast<std::size_t>(index)])
            fail("its nodes do not form a tree; export it again");
        m_seen[static_cast<std::size_t>(index)] = true;
        const tinygltf::Node& node = m_model.nodes[static_cast<std::size_t>(index)];
        const Affine3d to_world = parent * transform_of(node);
        if (node.mesh >= 0) read_mesh(index, to_world);
        for (const int child : node.children) visit(child, to_world, depth + 1);
    }

    void read_mesh(int node_index, const Affine3d& to_world) {
        const tinygltf::Node& node = m_model.nodes[static_cast<std::size_t>(node_index)];
        if (static_cast<std::size_t>(node.mesh) >= m_model.meshes.size())
            fail("a mesh is missing; export it again");
        const tinygltf::Mesh& mesh = m_model.meshes[static_cast<std::size_t>(node.mesh)];
        const std::string& name = node.name.empty() ? mesh.name : node.name;
        if (node.skin >= 0)
            fail(fmt::format("\"{}\" is bent by a skeleton; apply the armature before exporting", name));
        if (!to_world.matrix().allFinite() || to_world.linear().determinant() == 0)
            fail(fmt::format("\"{}\" is scaled to nothing; export it again", name));
        for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
            const tinygltf::Primitive& primitive = mesh.primitives[p];
            if (!primitive.targets.empty())
                fail(fmt::format("\"{}\" has shape keys (morph targets); apply them before exporting", name));
            const bool has_triangles = primitive.mode < 0 || primitive.mode >= TINYGLTF_MODE_TRIANGLES;
            if (!has_triangles || !primitive.attributes.contains("POSITION")) continue;
            Group group{name, {}, node_index, static_cast<int>(p), to_world};
            try {
                read_primitive(primitive, std::move(group));
            } catch (const std::out_of_range& problem) {
                fail(fmt::format("{} (in \"{}\"); export it again", problem.what(), name));
            }
        }
    }

    void read_primitive(const tinygltf::Primitive& primitive, Group group) {
        const std::vector<double> positions = values_of("POSITION", primitive.attributes.at("POSITION"));
        const std::size_t count = positions.size() / 3;
        std::vector<std::int32_t> indices;
        if (primitive.indices >= 0) {
            for (const std::uint32_t i : accessor_indices(m_model, primitive.indices, count))
                indices.push_back(static_cast<std::int32_t>(i));
        } else {
            for (std::size_t i = 0; i < count; ++i) indices.push_back(static_cast<std::int32_t>(i));
        }
        const std::vector<std::int32_t> corners = triangles_of(indices, primitive.mode);
        if (corners.size() % 3 != 0) throw std::out_of_range("its indices do not make triangles");

        // Primitives may share their vertices; each takes those that it uses.
        std::vector<std::int32_t> number(count, -1);
        for (const std::int32_t v : corners) number[static_cast<std::size_t>(v)] = 0;
        const std::size_t first = m_mesh.positions.size();
        for (std::size_t v = 0; v < count; ++v) {
            if (number[v] < 0) continue;
            number[v] = static_cast<std::int32_t>(m_mesh.positions.size());
            m_mesh.positions.emplace_back(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]);
            m_mesh.vertex_groups.push_back(static_cast<std::int32_t>(m_mesh.groups.size()));
        }
        read_attributes(primitive, number, first);
        if (std::max(m_mesh.corners.size() + corners.size(), m_mesh.positions.size()) > kMaxCorners)
            fail("the mesh is too large; decimate it");
        const bool has_material =
            primitive.material >= 0 && primitive.material < static_cast<int>(m_model.materials.size());
        const FaceInfo info{static_cast<std::int32_t>(m_mesh.groups.size()),
                            has_material ? primitive.material : -1, 0};
        for (std::size_t c = 0; c < corners.size(); ++c) {
            m_mesh.corners.push_back(number[static_cast<std::size_t>(corners[c])]);
            if (c % 3 == 2) {
                m_mesh.face_starts.push_back(m_mesh.corners.size());
                m_mesh.faces.push_back(info);
            }
        }
        m_mesh.groups.push_back(std::move(group));
    }

    std::vector<double> values_of(const std::string& attribute, int accessor) const {
        if (accessor < 0 || static_cast<std::size_t>(accessor) >= m_model.accessors.size())
            throw std::out_of_range(fmt::format("there is no accessor {}", accessor));
        check_components(attribute, component_count(m_model.accessors[static_cast<std::size_t>(accessor)]));
        return accessor_values(m_model, accessor);
    }

    void read_attributes(const tinygltf::Primitive& primitive, const std::vector<std::int32_t>& number,
                         std::size_t first) {
        for (const auto& [name, accessor] : primitive.attributes) {
            if (name == "POSITION") continue;
            if (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_")) {
                m_mesh.warnings.push_back(fmt::format("{} is left out: there is no skeleton", name));
                continue;
            }
            const std::vector<double> values = values_of(name, accessor);
            const int components = component_count(m_model.accessors[static_cast<std::size_t>(accessor)]);
            auto& all = m_mesh.attributes;
            const std::string& wanted = name;  // clang captures no structured bindings
            auto found =
                std::find_if(all.begin(), all.end(), [&](const Attribute& a) { return a.name == wanted; });
            if (found == all.end()) {
                all.push_back(attribute_named(name, components));
                // One length for all primitives; an opaque colour may have three components or four.
                if (all.back().role == Role::Colour) all.back().components = 4;
                found = all.end() - 1;
            }
            const auto width = static_cast<std::size_t>(found->components);
            if (found->role != Role::Colour && components != found->components)
                throw std::out_of_range(fmt::format("{} has two lengths", name));
            if (values.size() / static_cast<std::size_t>(components) < number.size())
                throw std::out_of_range(fmt::format("{} is too short", name));
            found->values.resize(width * first, kAbsent);
            for (std::size_t v = 0; v < number.size(); ++v)
                for (std::size_t k = 0; k < width && number[v] >= 0; ++k)
                    found->values.push_back(k < static_cast<std::size_t>(components)
                                                ? values[v * static_cast<std::size_t>(components) + k]
                                                : 1.0);
        }
        for (Attribute& attribute : m_mesh.attributes)
            attribute.values.resize(static_cast<std::size_t>(attribute.components) * m_mesh.positions.size(),
                                    kAbsent);
    }

    const tinygltf::Model& m_model;
    const std::string& m_name;
    Mesh m_mesh;
    std::vector<bool> m_seen;
};

}  // namespace

Mesh read_gltf(std::span<const std::byte> bytes, const std::string& name, Format format,
               const std::filesystem::path& folder) {
    auto source = std::make_shared<GltfSource>(format);
    source->folder = folder;
    load(source->model, bytes, name, format, folder.string());
    Mesh mesh = GltfReader(source->model, name).take();
    mesh.source = source;
    return mesh;
}

}  // namespace windfall::meshfile
