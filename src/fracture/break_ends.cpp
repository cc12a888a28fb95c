#include "fracture/break_ends.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "fracture/break_buffers.h"

namespace windfall::fracture {
namespace {

// A surface whose mean lies no higher than this above its lowest point is flat: no factor makes it rough.
constexpr double kFlat = 1e-6;

void scale_heights(double factor, SurfaceVertices& v) {
    const auto f = static_cast<float>(factor);
    for (float& z : v.z) z *= f;
}

/// The stub's places and attributes from the flat arrays.
void fill_stub(const BreakWorkspace::Buffers& b, BranchMesh& mesh) {
    const SurfaceVertices& v = b.vertices;
    const std::size_t count = v.x.size();
    mesh.positions.resize(count);
    for (std::size_t i = 0; i < count; ++i) mesh.positions[i] = {v.x[i], v.y[i], v.z[i]};
    mesh.tissue = v.tissue;
    mesh.bundle = v.name;
    mesh.thorn.assign(count, 0.0F);
}

/// The same surface seen from the other side.
void reverse_into(const BranchMesh& stub, BranchMesh& piece) {
    piece.positions = stub.positions;
    piece.tissue = stub.tissue;
    piece.bundle = stub.bundle;
    piece.thorn = stub.thorn;
    piece.parts = stub.parts;
    const std::size_t faces = stub.faces.size();
    piece.faces.resize(faces);
    piece.corner_uvs.resize(faces);
    for (std::size_t f = 0; f < faces; ++f) {
        const geometry::Face& a = stub.faces[f];
        const auto& uv = stub.corner_uvs[f];
        if (a[3] == geometry::kNoVertex) {
            piece.faces[f] = {a[2], a[1], a[0], a[3]};
            piece.corner_uvs[f] = {uv[2], uv[1], uv[0], uv[3]};
        } else {
            piece.faces[f] = {a[0], a[3], a[2], a[1]};  // the same diagonal between 0 and 2
            piece.corner_uvs[f] = {uv[0], uv[3], uv[2], uv[1]};
        }
    }
}

/// Where one end has a thorn, the other end's surface gives way to its tip.
void make_holes(const std::vector<float>& thorn, BreakEnds& ends) {
    for (std::size_t i = 0; i < thorn.size(); ++i) {
        if (thorn[i] > 0) ends.piece.positions[i].z() += thorn[i];
        if (thorn[i] < 0) ends.stub.positions[i].z() += thorn[i];
    }
}

void find_extremes(BreakEnds& ends) {
    float low = 0, high = 0;
    for (const Vector3f& p : ends.stub.positions) low = std::min(low, p.z());
    for (const Vector3f& p : ends.piece.positions) high = std::max(high, p.z());
    for (const Vector3f& p : ends.stub.positions) high = std::max(high, p.z());
    for (const Vector3f& p : ends.piece.positions) low = std::min(low, p.z());
    ends.lowest = low;
    ends.highest = high;
}

void copy_heights(BranchMesh& mesh) {
    mesh.height.resize(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.height.size(); ++i) mesh.height[i] = mesh.positions[i].z();
}

}  // namespace

BreakWorkspace::BreakWorkspace() : m_buffers(std::make_unique<Buffers>()) {}
BreakWorkspace::~BreakWorkspace() = default;
BreakWorkspace::BreakWorkspace(BreakWorkspace&&) noexcept = default;
BreakWorkspace& BreakWorkspace::operator=(BreakWorkspace&&) noexcept = default;

double mean_height(const SurfaceVertices& v, const std::vector<geometry::Face>& faces, std::size_t count) {
    double volume = 0, area = 0;
    const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
        const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b),
                   k = static_cast<std::size_t>(c);
        const double twice = (v.x[j] - v.x[i]) * (v.y[k] - v.y[i]) - (v.y[j] - v.y[i]) * (v.x[k] - v.x[i]);
        area += twice;
        volume += twice * (v.z[i] + v.z[j] + v.z[k]) / 3;
    };
    for (std::size_t f = 0; f < count; ++f) {
        add(faces[f][0], faces[f][1], faces[f][2]);
        if (faces[f][3] != geometry::kNoVertex) add(faces[f][0], faces[f][2], faces[f][3]);
    }
    return volume / area - *std::min_element(v.z.begin(), v.z.end());
}

void make_break_ends(const FractureParameters& parameters, BreakEnds& ends, BreakWorkspace& workspace) {
    BreakWorkspace::Buffers& b = workspace.buffers();
    lay_out_lattice(parameters, b.lattice);
    fill_cells(parameters, b);
    build_surface(parameters, b, ends);
    ends.mean_height = mean_height(b.vertices, ends.stub.faces, ends.surface_faces);
    if (parameters.fracture.height_from != HeightSource::Amplitudes) {
        if (ends.mean_height <= kFlat)
            throw InputError(
                fmt::format("the broken surface is flat, so that nothing can be scaled to the mean height of "
                            "{:.4g} radii: "
                            "give it break.tilt_deg, roughness.* or bundles.*, or set break.height_from = "
                            "\"amplitudes\"",
                            parameters.fracture.mean_height));
        scale_heights(parameters.fracture.mean_height / ends.mean_height, b.vertices);
        ends.mean_height = parameters.fracture.mean_height;
    }
    fill_stub(b, ends.stub);
    reverse_into(ends.stub, ends.piece);
    make_holes(b.vertices.thorn, ends);
    find_extremes(ends);
    copy_heights(ends.stub);
    copy_heights(ends.piece);
    add_thorns(parameters, b, ends);
}

}  // namespace windfall::fracture
