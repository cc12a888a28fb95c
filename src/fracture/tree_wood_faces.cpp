#include "fracture/tree_wood_faces.h"

#include <algorithm>
#include <cmath>

#include "fracture/tree_wood.h"
#include "fracture/wood_colour.h"

namespace windfall::fracture {
namespace {

using geometry::kNoVertex;
using meshfile::Attribute;
using meshfile::Role;

double srgb_part(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

std::string free_name(const std::string& name, const std::vector<meshfile::Material>& materials) {
    std::string result = name;
    while (std::any_of(materials.begin(), materials.end(), [&](const auto& m) { return m.name == result; }))
        result += "_snap";
    return result;
}

std::array<Vector3f, kPartCount> mean_colours(const BranchMesh& mesh, const std::vector<Vector3f>& colours) {
    std::array<Vector3f, kPartCount> sum;
    std::array<float, kPartCount> count{};
    sum.fill(Vector3f::Zero());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const auto part = static_cast<std::size_t>(mesh.parts[f]);
        sum[part] += colours[static_cast<std::size_t>(mesh.faces[f][0])];
        ++count[part];
    }
    for (std::size_t part = 0; part < sum.size(); ++part)
        sum[part] = count[part] > 0 ? Vector3f(sum[part] / count[part]) : Vector3f(Vector3f::Constant(0.5F));
    return sum;
}

}  // namespace

WoodFaces::WoodFaces(const TreePartPlan& plan, const FittedWood& wood, std::int32_t group,
                     meshfile::Mesh& target)
    : m_wood(wood),
      m_target(target),
      m_normals(corner_normals(wood.mesh, wood.places, plan.branch.centre, plan.branch.radius)),
      m_colours(vertex_colours(wood.mesh, plan.parameters)),
      // Normals go by the transposed inverse (glTF 2.0, 3.7.2.1), and back by the transpose.
      m_normal_from_world(plan.mesh.groups[static_cast<std::size_t>(group)].to_world.linear().transpose()),
      m_is_gltf(!plan.mesh.vertex_groups.empty()) {
    auto& attributes = target.attributes;
    const auto is_colour = [](const Attribute& a) { return a.role == Role::Colour; };
    const auto colour = std::find_if(attributes.begin(), attributes.end(), is_colour);
    if (colour != attributes.end() && !m_is_gltf &&
        std::any_of(colour->values.begin(), colour->values.end(), [](double x) { return x > 1.5; }))
        m_colour_scale = 255;  // PLY's usual bytes
    if (colour == attributes.end() && m_is_gltf)
        attributes.push_back({"COLOR_0",
                              Role::Colour,
                              4,
                              std::vector<double>(4 * target.positions.size(), meshfile::kAbsent),
                              false,
                              {}});
    const std::array<Vector3f, kPartCount> means = mean_colours(wood.mesh, m_colours);
    for (std::size_t part = 0; part < m_info.size(); ++part) {
        if (!plan.parts[part]) continue;
        const bool has_colours = m_is_gltf || colour != attributes.end();
        const Vector3f base = has_colours && m_is_gltf ? Vector3f(Vector3f::Ones()) : means[part];
        m_info[part] = {group, static_cast<std::int32_t>(target.materials.size()), 0};
        target.materials.push_back(
            {free_name(part_names()[part], target.materials), -1, {base.x(), base.y(), base.z()}, 0.85F});
        if (!m_is_gltf) continue;
        meshfile::Group wood_group = target.groups[static_cast<std::size_t>(group)];
        wood_group.name = part_names()[part];
        wood_group.primitive = -1;
        m_info[part].group = static_cast<std::int32_t>(target.groups.size());
        target.groups.push_back(std::move(wood_group));
    }
}

void WoodFaces::fill(std::size_t face, std::size_t corner, double* values) const {
    const BranchMesh& mesh = m_wood.mesh;
    const Eigen::Vector3d normal =
        (m_normal_from_world * m_normals[face][corner].cast<double>()).normalized();
    const Vector3f& colour = m_colours[static_cast<std::size_t>(mesh.faces[face][corner])];
    for (const Attribute& attribute : m_target.attributes) {
        const int count = attribute.components;
        std::fill(values, values + count, meshfile::kAbsent);
        if (attribute.role == Role::TextureCoordinate) {
            const Vector2f& uv = mesh.corner_uvs[face][corner];
            values[0] = uv.x();
            // glTF's origin is the upper left.
            values[1] = m_is_gltf ? 1 - uv.y() : uv.y();
        } else if (attribute.role == Role::Normal) {
            std::copy(normal.begin(), normal.end(), values);
        } else if (attribute.role == Role::Colour) {
            for (int k = 0; k < count; ++k) {
                const double linear = k < 3 ? std::clamp<double>(colour[k], 0, 1) : 1.0;
                values[k] = m_is_gltf || k == 3 ? linear : srgb_part(linear);
                values[k] *= m_colour_scale;
            }
        }
        values += count;
    }
}

void WoodFaces::add(meshfile::FaceAppender& appender, std::vector<std::int32_t>& places) const {
    const BranchMesh& mesh = m_wood.mesh;
    for (std::size_t v = 0; v < places.size(); ++v)
        if (places[v] < 0) places[v] = appender.add_place(m_wood.places[v]);
    const std::size_t width = m_target.values_per_corner();
    std::vector<double> values(4 * width);
    std::array<meshfile::NewCorner, 4> corners;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const std::size_t count = mesh.faces[f][3] == kNoVertex ? 3 : 4;
        for (std::size_t k = 0; k < count; ++k) {
            fill(f, k, values.data() + k * width);
            corners[k] = {-1, places[static_cast<std::size_t>(mesh.faces[f][k])], values.data() + k * width};
        }
        appender.add_face(m_info[static_cast<std::size_t>(mesh.parts[f])], {corners.data(), count}, -1);
    }
}

}  // namespace windfall::fracture
