#include "export/glb.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <limits>
#include <set>
#include <sstream>

#include "core/error.h"
#include "core/version.h"
#include "export/seam_split.h"

namespace windfall::export_ {
namespace {

using Eigen::Vector3f;

// Grows the buffer of a model; every accessor has a view of its own.
class BufferBuilder {
  public:
    explicit BufferBuilder(tinygltf::Model& model) : m_model(model) { m_model.buffers.emplace_back(); }

    /// `target`: TINYGLTF_TARGET_*, or 0 for data that is neither vertices nor indices.
    template <class T>
    int add_view(const std::vector<T>& numbers, int target) {
        auto& data = m_model.buffers[0].data;
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = data.size();
        view.byteLength = numbers.size() * sizeof(T);
        view.target = target;
        // tinygltf writes offsets as int, so a larger buffer would come out wrong.
        if (view.byteOffset + view.byteLength > static_cast<std::size_t>(std::numeric_limits<int>::max()))
            throw InputError(
                "the animation does not fit into one GLB file (2 GiB); export single frames with --frame, or "
                "the "
                "sequence as obj or ply");
        data.resize(data.size() + view.byteLength);
        std::memcpy(data.data() + view.byteOffset, numbers.data(), view.byteLength);
        m_model.bufferViews.push_back(std::move(view));
        return static_cast<int>(m_model.bufferViews.size()) - 1;
    }

    int add_accessor(int view, int component_type, int type, std::size_t count) {
        tinygltf::Accessor accessor;
        accessor.bufferView = view;
        accessor.componentType = component_type;
        accessor.type = type;
        accessor.count = count;
        m_model.accessors.push_back(std::move(accessor));
        return static_cast<int>(m_model.accessors.size()) - 1;
    }

    int add_floats(const std::vector<float>& numbers, int type, int target) {
        const int width = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type));
        return add_accessor(add_view(numbers, target), TINYGLTF_COMPONENT_TYPE_FLOAT, type,
                            numbers.size() / static_cast<std::size_t>(width));
    }

    tinygltf::Accessor& accessor(int index) { return m_model.accessors[static_cast<std::size_t>(index)]; }

  private:
    tinygltf::Model& m_model;
};

void set_bounds(tinygltf::Accessor& accessor, const std::vector<float>& numbers, std::size_t width) {
    accessor.minValues.assign(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(width));
    accessor.maxValues = accessor.minValues;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        accessor.minValues[i % width] = std::min<double>(accessor.minValues[i % width], numbers[i]);
        accessor.maxValues[i % width] = std::max<double>(accessor.maxValues[i % width], numbers[i]);
    }
}

// Three floats for every new vertex, of the vertex that it is a copy of.
template <class VectorAt>
std::vector<float> gathered3(const SeamSplit& split, const VectorAt& vector_at) {
    std::vector<float> numbers;
    numbers.reserve(3 * split.source.size());
    for (const auto v : split.source) {
        const Vector3f vector = vector_at(static_cast<std::size_t>(v));
        numbers.insert(numbers.end(), vector.begin(), vector.end());
    }
    return numbers;
}

// Displacements of a morph target; as a list of those that are not zero where that is shorter.
int add_displacements(BufferBuilder& buffer, const std::vector<float>& numbers) {
    std::vector<std::uint32_t> moved;
    const std::size_t count = numbers.size() / 3;
    for (std::size_t i = 0; i < count; ++i)
        if (numbers[3 * i] != 0 || numbers[3 * i + 1] != 0 || numbers[3 * i + 2] != 0)
            moved.push_back(static_cast<std::uint32_t>(i));
    constexpr std::size_t kVectorBytes = 3 * sizeof(float);
    int index = -1;
    if (moved.size() * (kVectorBytes + sizeof(std::uint32_t)) >= count * kVectorBytes) {
        index = buffer.add_floats(numbers, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
    } else {
        if (moved.empty()) moved.push_back(0);  // glTF has no empty list
        std::vector<float> values;
        for (const auto i : moved)
            values.insert(values.end(), numbers.begin() + 3 * std::ptrdiff_t{i},
                          numbers.begin() + 3 * std::ptrdiff_t{i} + 3);
        index = buffer.add_accessor(-1, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, count);
        auto& sparse = buffer.accessor(index).sparse;
        sparse.isSparse = true;
        sparse.count = static_cast<int>(moved.size());
        sparse.indices.byteOffset = sparse.values.byteOffset = 0;  // tinygltf leaves them undefined
        sparse.indices.bufferView = buffer.add_view(moved, 0);
        sparse.indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        sparse.values.bufferView = buffer.add_view(values, 0);
    }
    set_bounds(buffer.accessor(index), numbers, 3);
    return index;
}

// glTF asks for a leading underscore; capitals are its custom.
std::string attribute_name(const std::string& name, const std::map<std::string, int>& taken) {
    std::string result = "_";
    for (const char c : name) result += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    while (taken.contains(result)) result += '_';
    return result;
}

void add_attribute(BufferBuilder& buffer, tinygltf::Primitive& primitive, const SeamSplit& split,
                   const take::Attribute& attribute) {
    constexpr int kTypes[] = {TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3,
                              TINYGLTF_TYPE_VEC4};
    const auto components = static_cast<std::size_t>(attribute.components);
    const auto add = [&](const std::string& name, std::size_t first, std::size_t width) {
        std::vector<float> numbers;
        for (const auto v : split.source)
            for (std::size_t k = first; k < first + width; ++k)
                numbers.push_back(attribute.values[static_cast<std::size_t>(v) * components + k]);
        primitive.attributes[attribute_name(name, primitive.attributes)] =
            buffer.add_floats(numbers, kTypes[width - 1], TINYGLTF_TARGET_ARRAY_BUFFER);
    };
    const auto names = component_names(attribute);
    if (components <= 4) {
        const std::string& first = names.front();  // "name", or "name_x"
        add(components == 1 ? first : first.substr(0, first.size() - 2), 0, components);
    } else {
        for (std::size_t k = 0; k < components; ++k) add(names[k], k, 1);
    }
}

tinygltf::Primitive static_primitive(BufferBuilder& buffer, const MeshToExport& mesh,
                                     const SeamSplit& split) {
    constexpr int kVertices = TINYGLTF_TARGET_ARRAY_BUFFER;
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = 0;
    primitive.indices =
        buffer.add_accessor(buffer.add_view(split.indices, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER),
                            TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, split.indices.size());

    const auto positions = gathered3(split, [&](std::size_t v) { return mesh.positions[v].cast<float>(); });
    const int position = buffer.add_floats(positions, TINYGLTF_TYPE_VEC3, kVertices);
    set_bounds(buffer.accessor(position), positions, 3);
    primitive.attributes["POSITION"] = position;
    const auto normals = gathered3(split, [&](std::size_t v) { return mesh.normals[v].cast<float>(); });
    primitive.attributes["NORMAL"] = buffer.add_floats(normals, TINYGLTF_TYPE_VEC3, kVertices);
    if (!split.uvs.empty()) {
        std::vector<float> uvs;
        for (const auto& uv : split.uvs)  // glTF's origin is the upper left
            uvs.insert(uvs.end(), {static_cast<float>(uv.x()), static_cast<float>(1 - uv.y())});
        primitive.attributes["TEXCOORD_0"] = buffer.add_floats(uvs, TINYGLTF_TYPE_VEC2, kVertices);
    }
    for (const auto& attribute : mesh.attributes) add_attribute(buffer, primitive, split, attribute);
    return primitive;
}

// Key k of the animation shows frame k alone: target k - 1 with weight 1, and none at key 0.
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
    tinygltf::AnimationChannel channel;
    channel.sampler = 0;
    channel.target_node = 0;
    channel.target_path = "weights";
    tinygltf::Animation animation;
    animation.name = "ageing";
    animation.samplers.push_back(std::move(sampler));
    animation.channels.push_back(std::move(channel));
    model.animations.push_back(std::move(animation));
}

void add_morphs(BufferBuilder& buffer, tinygltf::Mesh& gltf_mesh, const MeshToExport& mesh,
                const SeamSplit& split, std::span<const MorphShape> later_frames) {
    tinygltf::Value::Array names;
    for (std::size_t t = 0; t < later_frames.size(); ++t) {
        const MorphShape& shape = later_frames[t];
        const auto moved = gathered3(split, [&](std::size_t v) -> Vector3f {
            return shape.positions[v] - mesh.positions[v].cast<float>();
        });
        const auto turned = gathered3(split, [&](std::size_t v) -> Vector3f {
            return shape.normals[v] - mesh.normals[v].cast<float>();
        });
        gltf_mesh.primitives[0].targets.push_back(
            {{"POSITION", add_displacements(buffer, moved)}, {"NORMAL", add_displacements(buffer, turned)}});
        names.emplace_back(fmt::format("frame_{:04}", t + 1));
    }
    gltf_mesh.weights.assign(later_frames.size(), 0.0);
    // Not in the standard, but read by Blender and three.js, and written by both.
    gltf_mesh.extras =
        tinygltf::Value(tinygltf::Value::Object{{"targetNames", tinygltf::Value(std::move(names))}});
}

tinygltf::Material gltf_material(const ExportMaterial& material, const std::string& name) {
    tinygltf::Material result;
    result.name = name;
    const auto& colour = material.base_colour;
    result.pbrMetallicRoughness.baseColorFactor = {colour[0], colour[1], colour[2], 1};
    result.pbrMetallicRoughness.metallicFactor = 0;
    result.pbrMetallicRoughness.roughnessFactor = material.roughness;
    return result;
}

}  // namespace

std::vector<std::byte> glb_bytes(const MeshToExport& mesh, const ExportMaterial& material,
                                 std::span<const MorphShape> later_frames, double frames_per_second) {
    const SeamSplit split = split_at_seams(mesh.positions.size(), mesh.faces, mesh.corner_uvs);
    tinygltf::Model model;
    BufferBuilder buffer(model);
    tinygltf::Mesh gltf_mesh;
    gltf_mesh.name = mesh.name;
    gltf_mesh.primitives.push_back(static_primitive(buffer, mesh, split));
    if (!later_frames.empty()) {
        add_morphs(buffer, gltf_mesh, mesh, split, later_frames);
        add_animation(model, buffer, later_frames.size(), frames_per_second);
    }
    model.meshes.push_back(std::move(gltf_mesh));
    model.materials.push_back(gltf_material(material, mesh.name));
    tinygltf::Node node;
    node.name = mesh.name;
    node.mesh = 0;
    model.nodes.push_back(std::move(node));
    tinygltf::Scene scene;
    scene.nodes = {0};
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
