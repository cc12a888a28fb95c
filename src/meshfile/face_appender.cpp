#include "meshfile/face_appender.h"

#include <algorithm>

namespace windfall::meshfile {

namespace {

/// The same number once it is rounded, or none on both sides.
bool same_value(double held, double wanted) {
    const double rounded = static_cast<float>(wanted);
    return held == rounded || (held != held && rounded != rounded);
}

bool same_values(const double* held, const double* wanted, int count) {
    return std::equal(held, held + count, wanted, same_value);
}

}  // namespace

FaceAppender::FaceAppender(MeshPart& part, const Mesh& old_mesh)
    : m_part(part), m_old(old_mesh), m_entries(part.mesh.attributes.size()) {}

std::int32_t FaceAppender::add_place(const Vec3& world) {
    m_places.push_back(world);
    return static_cast<std::int32_t>(m_places.size()) - 1;
}

bool FaceAppender::is_vertex(std::int32_t vertex, std::int32_t group, const double* values) const {
    const Mesh& mesh = m_part.mesh;
    const auto v = static_cast<std::size_t>(vertex);
    // Only where vertices belong to groups (glTF) do those of two groups differ.
    if (!mesh.vertex_groups.empty() && mesh.vertex_groups[v] != group) return false;
    for (const Attribute& attribute : mesh.attributes) {
        const auto width = static_cast<std::size_t>(attribute.components);
        if (!attribute.on_corners && !same_values(&attribute.values[v * width], values, attribute.components))
            return false;
        values += width;
    }
    return true;
}

std::int32_t FaceAppender::vertex_of(const NewCorner& corner, std::int32_t group) {
    Mesh& mesh = m_part.mesh;
    m_vertices.first.resize(m_places.size(), -1);
    std::int32_t& first = m_vertices.first[static_cast<std::size_t>(corner.place)];
    for (std::int32_t link = first; link >= 0;
         link = m_vertices.links[static_cast<std::size_t>(link)].second) {
        const std::int32_t vertex = m_vertices.links[static_cast<std::size_t>(link)].first;
        if (is_vertex(vertex, group, corner.values)) return vertex;
    }
    const auto vertex = static_cast<std::int32_t>(mesh.positions.size());
    m_vertices.links.emplace_back(vertex, first);
    first = static_cast<std::int32_t>(m_vertices.links.size()) - 1;

    while (m_from_world.size() < mesh.groups.size())
        m_from_world.push_back(mesh.groups[m_from_world.size()].to_world.inverse());
    const Vec3 local = m_from_world[static_cast<std::size_t>(group)] * place(corner.place);
    mesh.positions.emplace_back(local.cast<float>().cast<double>());
    if (!mesh.vertex_groups.empty()) mesh.vertex_groups.push_back(group);
    const double* values = corner.values;
    for (Attribute& attribute : mesh.attributes) {
        for (int k = 0; k < attribute.components && !attribute.on_corners; ++k)
            attribute.values.push_back(static_cast<float>(values[k]));
        values += attribute.components;
    }
    return vertex;
}

std::int32_t FaceAppender::entry_of(std::size_t attribute, std::int32_t place, const double* values) {
    if (values[0] != values[0]) return -1;
    Attribute& target = m_part.mesh.attributes[attribute];
    const auto width = static_cast<std::size_t>(target.components);
    Chain& chain = m_entries[attribute];
    chain.first.resize(m_places.size(), -1);
    std::int32_t& first = chain.first[static_cast<std::size_t>(place)];
    for (std::int32_t link = first; link >= 0; link = chain.links[static_cast<std::size_t>(link)].second) {
        const std::int32_t entry = chain.links[static_cast<std::size_t>(link)].first;
        if (same_values(&target.values[static_cast<std::size_t>(entry) * width], values, target.components))
            return entry;
    }
    const auto entry = static_cast<std::int32_t>(target.values.size() / width);
    chain.links.emplace_back(entry, first);
    first = static_cast<std::int32_t>(chain.links.size()) - 1;
    for (std::size_t k = 0; k < width; ++k) target.values.push_back(static_cast<float>(values[k]));
    return entry;
}

void FaceAppender::add_corner(const NewCorner& corner, std::int32_t group) {
    Mesh& mesh = m_part.mesh;
    const double* values = corner.values;
    if (corner.old_corner >= 0) {
        const auto old = static_cast<std::size_t>(corner.old_corner);
        mesh.corners.push_back(m_part.vertex_of[static_cast<std::size_t>(m_old.corners[old])]);
    } else {
        mesh.corners.push_back(vertex_of(corner, group));
    }
    for (std::size_t a = 0; a < mesh.attributes.size(); ++a) {
        Attribute& attribute = mesh.attributes[a];
        if (attribute.on_corners) {
            std::int32_t entry = -1;
            if (corner.old_corner >= 0) {
                entry = m_old.attributes[a].corner_entries[static_cast<std::size_t>(corner.old_corner)];
                if (entry >= 0) entry = m_part.entry_of[a][static_cast<std::size_t>(entry)];
            } else {
                entry = entry_of(a, corner.place, values);
            }
            attribute.corner_entries.push_back(entry);
        }
        if (values != nullptr) values += attribute.components;
    }
}

void FaceAppender::add_face(const FaceInfo& info, std::span<const NewCorner> corners,
                            std::ptrdiff_t columns_from) {
    Mesh& mesh = m_part.mesh;
    Group& group = mesh.groups[static_cast<std::size_t>(info.group)];
    group.changed = true;
    std::vector<NewCorner> turned(corners.begin(), corners.end());
    if (group.mirrored()) std::reverse(turned.begin(), turned.end());
    for (const NewCorner& corner : turned) add_corner(corner, info.group);
    mesh.face_starts.push_back(mesh.corners.size());
    mesh.faces.push_back(info);
    for (std::size_t k = 0; k < mesh.face_columns.size(); ++k)
        mesh.face_columns[k].values.push_back(
            columns_from < 0 ? 0.0 : m_old.face_columns[k].values[static_cast<std::size_t>(columns_from)]);
}

}  // namespace windfall::meshfile
