#include "export/glb_part.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace windfall::export_ {
namespace {

using Eigen::Vector3f;
using geometry::Vec3;

constexpr int kVertexData = TINYGLTF_TARGET_ARRAY_BUFFER;

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

/// Linear colours in parts of the material's base colour, which multiplies them again.
std::vector<float> relative_colours(const SeamSplit& split, const take::Attribute& colour,
                                    const std::array<double, 3>& base_colour) {
    std::vector<float> numbers;
    for (const auto v : split.source)
        for (std::size_t k = 0; k < 3; ++k) {
            const double part = colour.values[3 * static_cast<std::size_t>(v) + k] / base_colour[k];
            numbers.push_back(static_cast<float>(std::clamp(part, 0.0, 1.0)));
        }
    return numbers;
}

std::vector<float> normals_of(const GlbPart& part, const MeshToExport& mesh) {
    if (part.normals == NormalsOfPart::OfVertices)
        return gathered3(part.split, [&](std::size_t v) { return mesh.normals[v].cast<float>(); });
    std::vector<float> numbers;
    for (const auto face : part.split.face_of)
        for (int k = 0; k < 3; ++k) numbers.push_back(static_cast<float>(mesh.face_normals[face][k]));
    return numbers;
}

MaterialSplit split_of(const MeshToExport& mesh, std::size_t material, bool apart) {
    if (!mesh.face_materials.empty()) return split_material(mesh, material, apart);
    // all faces: the vertices stay in their order, those without a face too
    return {split_at_seams(mesh.positions.size(), mesh.faces, mesh.corner_uvs), {}};
}

}  // namespace

GlbPart add_part(BufferBuilder& buffer, const MeshToExport& mesh, std::size_t material,
                 const std::array<double, 3>& base_colour, NormalsOfPart normals) {
    GlbPart part{split_of(mesh, material, normals == NormalsOfPart::OfFaces), normals, {}};
    tinygltf::Primitive& primitive = part.primitive;
    const SeamSplit& split = part.split;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.indices =
        buffer.add_accessor(buffer.add_view(split.indices, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER),
                            TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, split.indices.size());

    const auto positions = gathered3(split, [&](std::size_t v) { return mesh.positions[v].cast<float>(); });
    const int position = buffer.add_floats(positions, TINYGLTF_TYPE_VEC3, kVertexData);
    set_bounds(buffer.accessor(position), positions, 3);
    primitive.attributes["POSITION"] = position;
    if (normals != NormalsOfPart::None)
        primitive.attributes["NORMAL"] =
            buffer.add_floats(normals_of(part, mesh), TINYGLTF_TYPE_VEC3, kVertexData);
    if (!split.uvs.empty()) {
        std::vector<float> uvs;
        for (const auto& uv : split.uvs)  // glTF's origin is the upper left
            uvs.insert(uvs.end(), {static_cast<float>(uv.x()), static_cast<float>(1 - uv.y())});
        primitive.attributes["TEXCOORD_0"] = buffer.add_floats(uvs, TINYGLTF_TYPE_VEC2, kVertexData);
    }
    for (const auto& attribute : mesh.attributes) {
        if (&attribute == mesh.colour())
            primitive.attributes["COLOR_0"] = buffer.add_floats(
                relative_colours(split, attribute, base_colour), TINYGLTF_TYPE_VEC3, kVertexData);
        else
            add_attribute(buffer, primitive, split, attribute);
    }
    return part;
}

void add_target(BufferBuilder& buffer, GlbPart& part, const MeshToExport& mesh, const MorphShape& shape) {
    std::map<std::string, int> target;
    target["POSITION"] = add_displacements(buffer, gathered3(part.split, [&](std::size_t v) -> Vector3f {
                                               return shape.positions[v] - mesh.positions[v].cast<float>();
                                           }));
    if (part.normals == NormalsOfPart::OfVertices)
        target["NORMAL"] = add_displacements(buffer, gathered3(part.split, [&](std::size_t v) -> Vector3f {
                                                 return shape.normals[v] - mesh.normals[v].cast<float>();
                                             }));
    part.primitive.targets.push_back(std::move(target));
}

}  // namespace windfall::export_
