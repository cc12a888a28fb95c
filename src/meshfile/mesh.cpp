#include "meshfile/mesh.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"

namespace windfall::meshfile {
namespace {

/// Numbers 0, 1, 2 ... for what is kept; -1 for the rest.
std::vector<std::int32_t> numbered(const std::vector<bool>& keep) {
    std::vector<std::int32_t> number(keep.size(), -1);
    std::int32_t next = 0;
    for (std::size_t i = 0; i < keep.size(); ++i)
        if (keep[i]) number[i] = next++;
    return number;
}

template <class T>
std::vector<T> kept(const std::vector<T>& values, const std::vector<std::int32_t>& number,
                    std::size_t width = 1) {
    std::vector<T> result;
    for (std::size_t i = 0; i < number.size() && !values.empty(); ++i)
        if (number[i] >= 0)
            result.insert(result.end(), values.begin() + static_cast<std::ptrdiff_t>(i * width),
                          values.begin() + static_cast<std::ptrdiff_t>((i + 1) * width));
    return result;
}

void keep_attribute(const Mesh& mesh, const Attribute& attribute, const std::vector<bool>& keep_corner,
                    const std::vector<bool>& keep_face, MeshPart& part) {
    Attribute result = attribute;
    const auto width = static_cast<std::size_t>(attribute.components);
    part.entry_of.emplace_back();
    if (attribute.on_corners) {
        std::vector<bool> keep(attribute.values.size() / width, false);
        for (std::size_t c = 0; c < keep_corner.size(); ++c)
            if (keep_corner[c] && attribute.corner_entries[c] >= 0)
                keep[static_cast<std::size_t>(attribute.corner_entries[c])] = true;
        auto& number = part.entry_of.back();
        number = numbered(keep);
        result.values = kept(attribute.values, number, width);
        result.corner_entries.clear();
        for (std::size_t f = 0; f < mesh.face_count(); ++f)
            for (std::size_t c = mesh.face_starts[f]; keep_face[f] && c < mesh.face_starts[f + 1]; ++c) {
                const std::int32_t entry = attribute.corner_entries[c];
                result.corner_entries.push_back(entry < 0 ? -1 : number[static_cast<std::size_t>(entry)]);
            }
    } else {
        result.values = kept(attribute.values, part.vertex_of, width);
    }
    part.mesh.attributes.push_back(std::move(result));
}

/// What of the attribute's numbers does not fit the mesh; empty when all does.
std::string misfit(const Mesh& mesh, const Attribute& attribute) {
    const auto width = static_cast<std::size_t>(attribute.components);
    if (attribute.components < 1 || attribute.values.size() % width != 0) return "broken entries";
    const std::size_t entries = attribute.values.size() / width;
    if (!attribute.on_corners)
        return entries == mesh.positions.size()
                   ? ""
                   : fmt::format("{} entries for {} vertices", entries, mesh.positions.size());
    if (attribute.corner_entries.size() != mesh.corners.size())
        return fmt::format("{} entries for {} corners", attribute.corner_entries.size(), mesh.corners.size());
    for (const std::int32_t entry : attribute.corner_entries)
        if (entry < -1 || (entry >= 0 && static_cast<std::size_t>(entry) >= entries))
            return fmt::format("a corner that points to entry {} of {}", entry, entries);
    return "";
}

void mark_changed_groups(const Mesh& mesh, const std::vector<bool>& keep_face, MeshPart& part) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        if (!keep_face[f]) part.mesh.groups[static_cast<std::size_t>(mesh.faces[f].group)].changed = true;
}

}  // namespace

std::vector<Vec3> Mesh::world_positions() const {
    std::vector<Vec3> world = positions;
    for (std::size_t v = 0; v < vertex_groups.size(); ++v)
        world[v] = groups[static_cast<std::size_t>(vertex_groups[v])].to_world * positions[v];
    return world;
}

std::size_t Mesh::values_per_corner() const {
    std::size_t count = 0;
    for (const Attribute& attribute : attributes) count += static_cast<std::size_t>(attribute.components);
    return count;
}

void corner_values(const Mesh& mesh, std::size_t corner, double* values) {
    for (const Attribute& attribute : mesh.attributes) {
        const std::int32_t entry =
            attribute.on_corners ? attribute.corner_entries[corner] : mesh.corners[corner];
        for (int k = 0; k < attribute.components; ++k)
            *values++ = entry < 0
                            ? kAbsent
                            : attribute.values[static_cast<std::size_t>(entry * attribute.components + k)];
    }
}

MeshPart part_of(const Mesh& mesh, const std::vector<bool>& keep_face,
                 const std::vector<std::size_t>& more_corners) {
    std::vector<bool> keep_corner(mesh.corners.size(), false);
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        for (std::size_t c = mesh.face_starts[f]; keep_face[f] && c < mesh.face_starts[f + 1]; ++c)
            keep_corner[c] = true;
    for (const std::size_t c : more_corners) keep_corner[c] = true;
    std::vector<bool> keep_vertex(mesh.positions.size(), false);
    for (std::size_t c = 0; c < keep_corner.size(); ++c)
        if (keep_corner[c]) keep_vertex[static_cast<std::size_t>(mesh.corners[c])] = true;

    MeshPart part;
    part.vertex_of = numbered(keep_vertex);
    part.mesh.positions = kept(mesh.positions, part.vertex_of);
    part.mesh.vertex_groups = kept(mesh.vertex_groups, part.vertex_of);
    part.mesh.groups = mesh.groups;
    part.mesh.materials = mesh.materials;
    part.mesh.source = mesh.source;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        if (!keep_face[f]) continue;
        for (std::size_t c = mesh.face_starts[f]; c < mesh.face_starts[f + 1]; ++c)
            part.mesh.corners.push_back(part.vertex_of[static_cast<std::size_t>(mesh.corners[c])]);
        part.mesh.face_starts.push_back(part.mesh.corners.size());
        part.mesh.faces.push_back(mesh.faces[f]);
    }
    const std::vector<std::int32_t> face_number = numbered(keep_face);
    for (const FaceColumn& column : mesh.face_columns)
        part.mesh.face_columns.push_back({column.name, kept(column.values, face_number)});
    for (const Attribute& attribute : mesh.attributes)
        keep_attribute(mesh, attribute, keep_corner, keep_face, part);
    mark_changed_groups(mesh, keep_face, part);
    return part;
}

void check(const Mesh& mesh, const std::string& name) {
    if (mesh.faces.empty())
        throw InputError(
            fmt::format("{}: there are no faces in it; export the tree as a mesh of polygons", name));
    for (const std::int32_t v : mesh.corners)
        if (v < 0 || static_cast<std::size_t>(v) >= mesh.positions.size())
            throw InputError(fmt::format("{}: a face points to vertex {}, but there are {}; export it again",
                                         name, v, mesh.positions.size()));
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        if (!mesh.positions[v].allFinite())
            throw InputError(fmt::format(
                "{}: the position of vertex {} is not a finite number; repair the mesh where it was made",
                name, v));
    for (const Attribute& attribute : mesh.attributes)
        if (const std::string problem = misfit(mesh, attribute); !problem.empty())
            throw InputError(
                fmt::format("{}: \"{}\" has {}; export it again", name, attribute.name, problem));
    for (const FaceColumn& column : mesh.face_columns)
        if (column.values.size() != mesh.face_count())
            throw InputError(fmt::format("{}: \"{}\" has {} entries for {} faces; export it again", name,
                                         column.name, column.values.size(), mesh.face_count()));
}

}  // namespace windfall::meshfile
