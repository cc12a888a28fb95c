#pragma once
// A broken branch without the fracture process: a closed cylinder whose upper end is a field of fibre bundles
// (or sawn flat), to test colours, pictures and export with.
#include <cmath>
#include <numbers>

#include "fracture/branch_mesh.h"
#include "fracture/noise.h"
#include "take/frame.h"

namespace windfall::test {

struct SyntheticBranch {
    int rings = 8, sectors = 24, rows = 6;
    float length = 3;
    float step = 1;  ///< height of the tallest bundle; 0: sawn
    float phloem = 0.08F;
    std::uint32_t seed = 1;
};

/// Unplaced: radius 1 about z, the break at z = 0, the rest below.
inline fracture::BranchMesh synthetic_branch(const SyntheticBranch& shape) {
    using fracture::Part;
    using fracture::Tissue;
    fracture::BranchMesh mesh;
    const int rings = shape.rings, sectors = shape.sectors;
    const auto add_vertex = [&](float r, int sector, float z, Tissue tissue, std::uint32_t bundle,
                                float thorn) {
        const float angle =
            2 * std::numbers::pi_v<float> * static_cast<float>(sector) / static_cast<float>(sectors);
        mesh.positions.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
        mesh.height.push_back(z);
        mesh.thorn.push_back(thorn);
        mesh.tissue.push_back(tissue);
        mesh.bundle.push_back(bundle);
        return static_cast<std::int32_t>(mesh.positions.size()) - 1;
    };
    const auto add_face = [&](geometry::Face face, Part part) {
        mesh.faces.push_back(face);
        mesh.parts.push_back(part);
        std::array<fracture::Vector2f, 4> uvs;
        for (std::size_t k = 0; k < 4; ++k) {
            const auto v = static_cast<std::size_t>(face[k] < 0 ? face[2] : face[k]);
            uvs[k] = mesh.positions[v].head<2>() / 4 + fracture::Vector2f(0.25F, 0.25F);
        }
        mesh.corner_uvs.push_back(uvs);
    };
    const auto tissue_at = [&](float r) {
        return r > 0.999F             ? Tissue::Bark
               : r > 1 - shape.phloem ? Tissue::Phloem
               : r > 0.5F             ? Tissue::Sapwood
               : r > 0.06F            ? Tissue::Heartwood
                                      : Tissue::Pith;
    };
    const auto bundle_at = [&](int ring, int sector) {
        const float across = 0.07F * static_cast<float>(rings), r = static_cast<float>(ring);
        const auto i = static_cast<std::uint32_t>(r / across);
        const float around = std::max(1.0F, std::round(60 * r / static_cast<float>(rings)));
        const auto j = static_cast<std::uint32_t>(static_cast<float>(sector % sectors) * around /
                                                  static_cast<float>(sectors));
        return fracture::noise_key(shape.seed, fracture::NoisePurpose::BundleName, i, j);
    };
    const auto top_vertex = [&](int ring, int sector) {
        const float r = static_cast<float>(ring) / static_cast<float>(rings);
        const std::uint32_t bundle = bundle_at(ring, sector);
        const float u = fracture::unit_float(fracture::mixed_bits(bundle));
        const float z = ring == rings ? 0.15F * shape.step * u : shape.step * u * u;
        return add_vertex(r, sector, z, tissue_at(r), bundle, u > 0.97F ? 1.0F : 0.0F);
    };
    const auto cut_vertex = [&](int ring, int sector) {
        const float r = static_cast<float>(ring) / static_cast<float>(rings);
        return add_vertex(r, sector, -shape.length, tissue_at(r), bundle_at(ring, sector), 0);
    };
    // both ends: rows of vertices, ring by ring
    const auto disc = [&](const auto& vertex, bool up, Part part) {
        std::vector<std::int32_t> inner(static_cast<std::size_t>(sectors), vertex(0, 0)), outer = inner;
        for (int ring = 1; ring <= rings; ++ring) {
            for (int s = 0; s < sectors; ++s) outer[static_cast<std::size_t>(s)] = vertex(ring, s);
            for (int s = 0; s < sectors; ++s) {
                const auto a = static_cast<std::size_t>(s), b = static_cast<std::size_t>((s + 1) % sectors);
                geometry::Face face = ring == 1
                                          ? geometry::Face{inner[a], outer[a], outer[b], geometry::kNoVertex}
                                          : geometry::Face{inner[a], outer[a], outer[b], inner[b]};
                if (!up) std::swap(face[1], face[ring == 1 ? 2 : 3]);
                add_face(face, ring == rings ? Part::InnerBark : part);
            }
            inner = outer;
        }
        return outer;
    };
    std::vector<std::int32_t> above = disc(top_vertex, true, shape.step > 0 ? Part::Fibres : Part::EndGrain);
    const std::vector<std::int32_t> bottom = disc(cut_vertex, false, Part::EndGrain);
    for (int row = 1; row <= shape.rows; ++row) {
        std::vector<std::int32_t> below = bottom;
        const float t = static_cast<float>(row) / static_cast<float>(shape.rows);
        if (row < shape.rows)
            for (int s = 0; s < sectors; ++s)
                below[static_cast<std::size_t>(s)] = add_vertex(
                    1, s,
                    (1 - t) * mesh.height[static_cast<std::size_t>(above[static_cast<std::size_t>(s)])] -
                        t * shape.length,
                    Tissue::Bark, 0, 0);
        for (int s = 0; s < sectors; ++s) {
            const auto a = static_cast<std::size_t>(s), b = static_cast<std::size_t>((s + 1) % sectors);
            add_face({below[a], below[b], above[b], above[a]}, Part::Bark);
        }
        above = below;
    }
    return mesh;
}

/// In a take's coordinates (along y), with materials and attributes; `colours` one per vertex, linear.
inline take::TakeMesh wood_take_mesh(const std::string& name, const fracture::BranchMesh& branch,
                                     const std::vector<fracture::Vector3f>& colours) {
    take::TakeMesh mesh;
    mesh.name = name;
    take::Attribute tissue{"tissue", 1, {}}, height{"height", 1, branch.height},
        thorn{"thorn", 1, branch.thorn}, colour{"colour", 3, {}};
    for (std::size_t v = 0; v < branch.vertex_count(); ++v) {
        const fracture::Vector3f& p = branch.positions[v];
        mesh.rest.positions.emplace_back(p.x(), p.z(), -p.y());
        tissue.values.push_back(static_cast<float>(branch.tissue[v]));
        colour.values.insert(colour.values.end(), colours[v].begin(), colours[v].end());
    }
    mesh.attributes = {tissue, height, thorn, colour};
    mesh.rest.faces = branch.faces;
    for (const auto& corners : branch.corner_uvs) {
        mesh.rest.corner_uvs.emplace_back();
        for (std::size_t k = 0; k < 4; ++k) mesh.rest.corner_uvs.back()[k] = corners[k].cast<double>();
    }
    const char* const names[] = {"bark", "end_grain", "fibres", "thorns", "inner_bark", "crack"};
    for (int part = 0; part < fracture::kPartCount; ++part)
        mesh.materials.push_back({names[part], !fracture::is_smooth(static_cast<fracture::Part>(part))});
    for (const auto part : branch.parts) mesh.face_materials.push_back(static_cast<std::uint8_t>(part));
    return mesh;
}

/// The mesh where it is at rest, moved by `offset`.
inline take::Frame wood_frame(const std::vector<take::TakeMesh>& meshes, int index = 0,
                              const Eigen::Vector3f& offset = Eigen::Vector3f::Zero()) {
    take::Frame frame;
    frame.index = index;
    frame.time = 0.1 * index;
    for (const auto& mesh : meshes) {
        take::FrameMesh moved{mesh.name, {}, {}};
        for (const auto& p : mesh.rest.positions) moved.positions.emplace_back(p.cast<float>() + offset);
        frame.meshes.push_back(std::move(moved));
    }
    return frame;
}

}  // namespace windfall::test
