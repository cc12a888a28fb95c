#include "export/glb_curves.h"

#include <algorithm>

namespace windfall::export_ {

tinygltf::Mesh gltf_curves(BufferBuilder& buffer, const CurvesToExport& curves) {
    std::vector<float> positions, colours, radii;
    for (std::size_t point = 0; point < curves.points.size(); ++point) {
        const std::size_t strand = curves.strand_of(point);
        positions.insert(positions.end(), curves.points[point].begin(), curves.points[point].end());
        for (const float part : curves.colours[strand]) colours.push_back(std::clamp(part, 0.0F, 1.0F));
        radii.push_back(curves.radii[strand]);
    }
    std::vector<std::uint32_t> indices;
    for (const auto& segment : segments_of(curves))
        indices.insert(indices.end(), segment.begin(), segment.end());

    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_LINE;
    primitive.indices =
        buffer.add_accessor(buffer.add_view(indices, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER),
                            TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, indices.size());
    const int position = buffer.add_floats(positions, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
    set_bounds(buffer.accessor(position), positions, 3);
    primitive.attributes["POSITION"] = position;
    primitive.attributes["COLOR_0"] =
        buffer.add_floats(colours, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["_RADIUS"] =
        buffer.add_floats(radii, TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ARRAY_BUFFER);
    tinygltf::Mesh mesh;
    mesh.name = curves.name;
    mesh.primitives.push_back(std::move(primitive));
    return mesh;
}

}  // namespace windfall::export_
