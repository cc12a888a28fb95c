#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <sstream>

#include "core/error.h"
#include "core/version.h"
#include "meshfile/gltf.h"
#include "meshfile/gltf_source.h"
#include "meshfile/texture_path.h"
#include "meshfile/triangulate.h"

namespace windfall::meshfile {
namespace {

/// Keeps the names of textures that are files of their own.
bool keep_uri(const std::string* /*folder*/, const std::string* /*file*/, const tinygltf::Image* image,
              bool /*embed*/, std::string* uri, void* /*user*/) {
    *uri = image->uri;
    return true;
}

/// Builds a model from an old one: materials, lights and so on stay, data are gathered in one new buffer.
class GltfWriter {
  public:
    explicit GltfWriter(const Mesh& first) {
        if (const auto* source = dynamic_cast<const GltfSource*>(first.source.get())) {
            m_old = &source->model;
            m_folder = source->folder;
            m_model = source->model;
        }
        m_model.accessors.clear();
        m_model.bufferViews.clear();
        m_model.meshes.clear();
        m_model.buffers.assign(1, {});
        m_model.asset.version = "2.0";
        m_model.asset.generator = "Windfall " + program_version();
        if (m_model.scenes.empty()) {
            m_model.scenes.emplace_back();
            m_model.defaultScene = 0;
        }
        for (const Material& material : first.materials)
            if (material.source < 0) m_model.materials.push_back(new_material(material));
        keep_old_data();
    }

    void add(const NamedMesh& named, bool is_first) {
        const Mesh& mesh = *named.mesh;
        std::map<int, std::vector<std::size_t>> groups_of_node;
        for (std::size_t g = 0; g < mesh.groups.size(); ++g) groups_of_node[mesh.groups[g].node].push_back(g);
        m_faces_of_group.assign(mesh.groups.size(), {});
        for (std::size_t f = 0; f < mesh.face_count(); ++f)
            m_faces_of_group[static_cast<std::size_t>(mesh.faces[f].group)].push_back(f);
        m_vertices_of_group.assign(mesh.groups.size(), {});
        for (std::size_t v = 0; v < mesh.positions.size(); ++v)
            m_vertices_of_group[mesh.vertex_groups.empty() ? 0
                                                           : static_cast<std::size_t>(mesh.vertex_groups[v])]
                .push_back(v);

        std::vector<int> new_nodes;
        for (const auto& [node, groups] : groups_of_node) {
            const int gltf_mesh = mesh_of(mesh, node, groups, is_first);
            if (is_first && node >= 0) {
                m_model.nodes[static_cast<std::size_t>(node)].mesh = gltf_mesh;
            } else if (gltf_mesh >= 0) {
                new_nodes.push_back(add_node(mesh.groups[groups[0]], gltf_mesh));
            }
        }
        if (!is_first) new_nodes = {add_parent(named, std::move(new_nodes))};
        auto& roots = m_model.scenes[static_cast<std::size_t>(std::max(m_model.defaultScene, 0))].nodes;
        roots.insert(roots.end(), new_nodes.begin(), new_nodes.end());
    }

    std::vector<std::byte> bytes(Format format, const std::filesystem::path& folder) {
        for (tinygltf::Image& image : m_model.images)
            if (!image.uri.empty()) image.uri = moved_texture(image.uri, m_folder, folder);
        tinygltf::TinyGLTF writer;
        writer.SetImageWriter(keep_uri, nullptr);
        std::ostringstream stream;
        if (!writer.WriteGltfSceneToStream(&m_model, stream, format == Format::Gltf, format == Format::Glb))
            throw RunError("the glTF file could not be put together");
        const std::string text = std::move(stream).str();
        const auto raw = std::as_bytes(std::span(text));
        return {raw.begin(), raw.end()};
    }

  private:
    static tinygltf::Material new_material(const Material& material) {
        tinygltf::Material result;
        result.name = material.name;
        const auto& c = material.base_colour;
        result.pbrMetallicRoughness.baseColorFactor = {c[0], c[1], c[2], 1};
        result.pbrMetallicRoughness.metallicFactor = 0;
        result.pbrMetallicRoughness.roughnessFactor = material.roughness;
        return result;
    }

    int add_view(const void* data, std::size_t bytes, int target) {
        auto& buffer = m_model.buffers[0].data;
        buffer.resize((buffer.size() + 3) / 4 * 4);  // accessors are aligned
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = buffer.size();
        view.byteLength = bytes;
        view.target = target;
        if (buffer.size() + bytes > static_cast<std::size_t>(std::numeric_limits<int>::max()))
            throw InputError("the broken tree does not fit into one glTF file (2 GiB); decimate it");
        buffer.resize(buffer.size() + bytes);
        if (bytes > 0) std::memcpy(buffer.data() + view.byteOffset, data, bytes);
        m_model.bufferViews.push_back(std::move(view));
        return static_cast<int>(m_model.bufferViews.size()) - 1;
    }

    /// Copies an accessor of the old model; its data may lie between others there.
    int keep_accessor(int old, int target) {
        if (old < 0) return -1;
        const auto [found, is_new] = m_kept.try_emplace(old, static_cast<int>(m_model.accessors.size()));
        if (!is_new) return found->second;
        const std::vector<unsigned char> data = accessor_bytes(*m_old, old);
        tinygltf::Accessor accessor = m_old->accessors[static_cast<std::size_t>(old)];
        accessor.bufferView = add_view(data.data(), data.size(), target);
        accessor.byteOffset = 0;
        accessor.sparse = {};
        accessor.sparse.isSparse = false;
        m_model.accessors.push_back(std::move(accessor));
        return found->second;
    }

    void keep_old_data() {
        for (tinygltf::Image& image : m_model.images) {
            if (image.bufferView >= 0) {
                const std::vector<unsigned char> data = view_bytes(*m_old, image.bufferView);
                image.bufferView = add_view(data.data(), data.size(), 0);
            } else if (image.uri.empty()) {
                image.bufferView = add_view(image.image.data(), image.image.size(), 0);
            }
        }
        for (tinygltf::Skin& skin : m_model.skins)
            skin.inverseBindMatrices = keep_accessor(skin.inverseBindMatrices, 0);
        for (tinygltf::Animation& animation : m_model.animations)
            for (tinygltf::AnimationSampler& sampler : animation.samplers) {
                sampler.input = keep_accessor(sampler.input, 0);
                sampler.output = keep_accessor(sampler.output, 0);
            }
    }

    /// The number of a glTF mesh with the groups of one node; -1 when nothing is left of them. A mesh that
    /// the old model shows at several nodes stays one where nothing is changed in it.
    int mesh_of(const Mesh& mesh, int node, const std::vector<std::size_t>& groups, bool is_first) {
        const tinygltf::Mesh* old = nullptr;
        int old_index = -1;
        if (m_old != nullptr && node >= 0) {
            old_index = m_old->nodes[static_cast<std::size_t>(node)].mesh;
            old = &m_old->meshes[static_cast<std::size_t>(old_index)];
        }
        const bool whole = std::none_of(groups.begin(), groups.end(), [&](std::size_t g) {
            return mesh.groups[g].changed || mesh.groups[g].primitive < 0;
        });
        if (whole && old != nullptr)
            if (const auto found = m_whole.find(old_index); found != m_whole.end()) return found->second;
        tinygltf::Mesh result;
        result.name = old != nullptr ? old->name : mesh.groups[groups[0]].object;
        if (old != nullptr) {
            result.extras = old->extras;
            result.extensions = old->extensions;
        }
        for (const std::size_t g : groups)
            if (!m_faces_of_group[g].empty()) result.primitives.push_back(primitive_of(mesh, g, old));
        if (is_first && old != nullptr)
            for (const tinygltf::Primitive& p : old->primitives)
                if (p.mode >= 0 && p.mode < TINYGLTF_MODE_TRIANGLES)
                    result.primitives.push_back(kept_primitive(p));
        if (result.primitives.empty()) return -1;
        m_model.meshes.push_back(std::move(result));
        const int index = static_cast<int>(m_model.meshes.size()) - 1;
        if (whole && old != nullptr) m_whole[old_index] = index;
        return index;
    }

    /// Lines and points, which are not looked at.
    tinygltf::Primitive kept_primitive(tinygltf::Primitive primitive) {
        for (auto& [name, accessor] : primitive.attributes)
            accessor = keep_accessor(accessor, TINYGLTF_TARGET_ARRAY_BUFFER);
        primitive.indices = keep_accessor(primitive.indices, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
        return primitive;
    }

    tinygltf::Primitive primitive_of(const Mesh& mesh, std::size_t g, const tinygltf::Mesh* old) {
        tinygltf::Primitive primitive;
        const Group& group = mesh.groups[g];
        if (old != nullptr && group.primitive >= 0) {
            primitive.extras = old->primitives[static_cast<std::size_t>(group.primitive)].extras;
            primitive.extensions = old->primitives[static_cast<std::size_t>(group.primitive)].extensions;
        }
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = mesh.faces[m_faces_of_group[g][0]].material;
        const auto& vertices = m_vertices_of_group[g];
        std::vector<float> numbers;
        for (const std::size_t v : vertices)
            for (int k = 0; k < 3; ++k) numbers.push_back(static_cast<float>(mesh.positions[v][k]));
        primitive.attributes["POSITION"] = add_floats(numbers, 3, true);
        for (const Attribute& attribute : mesh.attributes) {
            const auto width = static_cast<std::size_t>(attribute.components);
            const double first = attribute.values[width * vertices[0]];
            if (first != first) continue;
            numbers.clear();
            for (const std::size_t v : vertices)
                for (std::size_t k = 0; k < width; ++k)
                    numbers.push_back(static_cast<float>(attribute.values[width * v + k]));
            primitive.attributes[attribute.name] = add_floats(numbers, attribute.components, false);
        }
        primitive.indices = add_indices(mesh, g);
        return primitive;
    }

    int add_floats(const std::vector<float>& numbers, int components, bool with_bounds) {
        tinygltf::Accessor accessor;
        accessor.bufferView =
            add_view(numbers.data(), numbers.size() * sizeof(float), TINYGLTF_TARGET_ARRAY_BUFFER);
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
        accessor.type =
            components == 1 ? TINYGLTF_TYPE_SCALAR : components;  // TINYGLTF_TYPE_VEC2 is 2, and so on
        const auto width = static_cast<std::size_t>(components);
        accessor.count = numbers.size() / width;
        for (std::size_t i = 0; with_bounds && i < numbers.size(); ++i) {
            if (i < width) {
                accessor.minValues.push_back(numbers[i]);
                accessor.maxValues.push_back(numbers[i]);
            }
            accessor.minValues[i % width] = std::min<double>(accessor.minValues[i % width], numbers[i]);
            accessor.maxValues[i % width] = std::max<double>(accessor.maxValues[i % width], numbers[i]);
        }
        m_model.accessors.push_back(std::move(accessor));
        return static_cast<int>(m_model.accessors.size()) - 1;
    }

    int add_indices(const Mesh& mesh, std::size_t g) {
        std::vector<std::uint32_t> local(mesh.positions.size(), 0);
        for (std::size_t i = 0; i < m_vertices_of_group[g].size(); ++i)
            local[m_vertices_of_group[g][i]] = static_cast<std::uint32_t>(i);
        std::vector<std::uint32_t> indices;
        for (const std::size_t f : m_faces_of_group[g])
            for (const auto& triangle : triangulated(mesh, f))
                for (const std::size_t corner : triangle)
                    indices.push_back(local[static_cast<std::size_t>(mesh.corners[corner])]);
        tinygltf::Accessor accessor;
        accessor.type = TINYGLTF_TYPE_SCALAR;
        accessor.count = indices.size();
        if (m_vertices_of_group[g].size() < std::numeric_limits<std::uint16_t>::max()) {
            const std::vector<std::uint16_t> small(indices.begin(), indices.end());
            accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
            accessor.bufferView = add_view(small.data(), small.size() * sizeof(std::uint16_t),
                                           TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
        } else {
            accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
            accessor.bufferView = add_view(indices.data(), indices.size() * sizeof(std::uint32_t),
                                           TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
        }
        m_model.accessors.push_back(std::move(accessor));
        return static_cast<int>(m_model.accessors.size()) - 1;
    }

    int add_node(const Group& group, int gltf_mesh) {
        tinygltf::Node node;
        node.name = group.object;
        node.mesh = gltf_mesh;
        const auto& matrix = group.to_world.matrix();
        if (!matrix.isIdentity(0)) node.matrix.assign(matrix.data(), matrix.data() + 16);
        m_model.nodes.push_back(std::move(node));
        return static_cast<int>(m_model.nodes.size()) - 1;
    }

    int add_parent(const NamedMesh& named, std::vector<int> children) {
        tinygltf::Node node;
        node.name = named.name;
        node.children = std::move(children);
        if (!named.shift.isZero()) node.translation.assign(named.shift.data(), named.shift.data() + 3);
        m_model.nodes.push_back(std::move(node));
        return static_cast<int>(m_model.nodes.size()) - 1;
    }

    tinygltf::Model m_model;
    const tinygltf::Model* m_old = nullptr;
    std::filesystem::path m_folder;
    std::map<int, int> m_kept;   // accessors: new number by old one
    std::map<int, int> m_whole;  // meshes that are what they were: new number by old one
    std::vector<std::vector<std::size_t>> m_faces_of_group, m_vertices_of_group;
};

}  // namespace

std::vector<OutputFile> encode_gltf(std::span<const NamedMesh> meshes, const std::filesystem::path& path,
                                    Format format) {
    GltfWriter writer(*meshes[0].mesh);
    for (const NamedMesh& named : meshes) writer.add(named, &named == meshes.data());
    return {{path, writer.bytes(format, path.parent_path())}};
}

}  // namespace windfall::meshfile
