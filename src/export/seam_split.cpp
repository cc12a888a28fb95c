#include "export/seam_split.h"

#include <map>
#include <numeric>
#include <tuple>

namespace windfall::export_ {

SeamSplit split_at_seams(std::size_t vertex_count, const std::vector<geometry::Face>& faces,
                         const std::vector<std::array<geometry::Vec2, 4>>& corner_uvs) {
    SeamSplit split;
    if (corner_uvs.empty()) {
        split.source.resize(vertex_count);
        std::iota(split.source.begin(), split.source.end(), 0);
    }
    std::map<std::tuple<std::int32_t, double, double>, std::uint32_t> copies;
    const auto new_vertex = [&](std::size_t f, int c) {
        const std::int32_t v = faces[f][c];
        if (corner_uvs.empty()) return static_cast<std::uint32_t>(v);
        const geometry::Vec2& uv = corner_uvs[f][c];
        const auto next = static_cast<std::uint32_t>(split.source.size());
        const auto [found, is_new] = copies.try_emplace({v, uv.x(), uv.y()}, next);
        if (is_new) {
            split.source.push_back(v);
            split.uvs.push_back(uv);
        }
        return found->second;
    };
    for (std::size_t f = 0; f < faces.size(); ++f) {
        std::array<std::uint32_t, 4> corner{};
        const int corners = geometry::corner_count(faces[f]);
        for (int c = 0; c < corners; ++c) corner[c] = new_vertex(f, c);
        for (int c = 2; c < corners; ++c)
            split.indices.insert(split.indices.end(), {corner[0], corner[c - 1], corner[c]});
    }
    return split;
}

MaterialSplit split_material(const MeshToExport& mesh, std::size_t material, bool apart) {
    MaterialSplit split;
    std::map<std::tuple<std::int32_t, double, double>, std::uint32_t> copies;
    const auto new_vertex = [&](std::size_t f, int c) {
        const std::int32_t v = mesh.faces[f][c];
        const geometry::Vec2 uv = mesh.corner_uvs.empty() ? geometry::Vec2::Zero() : mesh.corner_uvs[f][c];
        const auto next = static_cast<std::uint32_t>(split.source.size());
        if (!apart) {
            const auto [found, is_new] = copies.try_emplace({v, uv.x(), uv.y()}, next);
            if (!is_new) return found->second;
        } else {
            split.face_of.push_back(static_cast<std::uint32_t>(f));
        }
        split.source.push_back(v);
        if (!mesh.corner_uvs.empty()) split.uvs.push_back(uv);
        return next;
    };
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        if (mesh.material_of(f) != material) continue;
        std::array<std::uint32_t, 4> corner{};
        const int corners = geometry::corner_count(mesh.faces[f]);
        for (int c = 0; c < corners; ++c) corner[c] = new_vertex(f, c);
        for (int c = 2; c < corners; ++c)
            split.indices.insert(split.indices.end(), {corner[0], corner[c - 1], corner[c]});
    }
    return split;
}

}  // namespace windfall::export_
