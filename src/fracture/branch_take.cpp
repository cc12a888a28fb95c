#include "fracture/branch_take.h"

#include "fracture/noise.h"

namespace windfall::fracture {
namespace {

template <class Values, class Of>
take::Attribute scalar(const std::string& name, const Values& values, Of of) {
    take::Attribute attribute{name, 1, {}};
    attribute.values.reserve(values.size());
    for (const auto& value : values) attribute.values.push_back(of(value));
    return attribute;
}

}  // namespace

take::TakeMesh take_mesh(const std::string& name, const BranchMesh& mesh,
                         const std::vector<Vector3f>& colours) {
    take::TakeMesh result;
    result.name = name;
    result.rest.positions.reserve(mesh.positions.size());
    for (const Vector3f& p : mesh.positions) result.rest.positions.emplace_back(take_axes(p).cast<double>());
    result.rest.faces = mesh.faces;
    result.rest.corner_uvs.reserve(mesh.corner_uvs.size());
    for (const auto& uv : mesh.corner_uvs)
        result.rest.corner_uvs.push_back(
            {uv[0].cast<double>(), uv[1].cast<double>(), uv[2].cast<double>(), uv[3].cast<double>()});
    for (int part = 0; part < kPartCount; ++part)
        result.materials.push_back(
            {part_names()[static_cast<std::size_t>(part)], !is_smooth(static_cast<Part>(part))});
    result.face_materials.reserve(mesh.parts.size());
    for (const Part part : mesh.parts) result.face_materials.push_back(static_cast<std::uint8_t>(part));
    result.attributes.push_back(
        scalar("tissue", mesh.tissue, [](Tissue t) { return static_cast<float>(t); }));
    result.attributes.push_back(scalar("height", mesh.height, [](float z) { return z; }));
    result.attributes.push_back(scalar("thorn", mesh.thorn, [](float t) { return t; }));
    result.attributes.push_back(scalar("bundle", mesh.bundle, unit_float));
    take::Attribute colour{"colour", 3, {}};
    colour.values.reserve(3 * colours.size());
    for (const Vector3f& c : colours) colour.values.insert(colour.values.end(), {c.x(), c.y(), c.z()});
    result.attributes.push_back(std::move(colour));
    return result;
}

take::FrameMesh frame_mesh(const std::string& name, const std::vector<Vector3f>& positions) {
    take::FrameMesh result;
    result.name = name;
    result.positions.reserve(positions.size());
    for (const Vector3f& p : positions) result.positions.push_back(take_axes(p));
    return result;
}

}  // namespace windfall::fracture
