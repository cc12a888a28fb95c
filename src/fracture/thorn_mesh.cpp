#include "fracture/thorn_mesh.h"

#include <algorithm>
#include <utility>

#include "core/angles.h"
#include "fracture/noise.h"

namespace windfall::fracture {
namespace {

using geometry::kNoVertex;

/// Adds rows of points from the root to the tip and the faces between them; on the piece, where the tip is
/// below, all faces turn round. The room for all of them is made at once.
class Body {
  public:
    Body(const ThornShape& shape, std::size_t vertices, std::size_t faces, BranchMesh& mesh)
        : m_surface(shape.surface),
          m_over_length(1 / (shape.tip - shape.surface)),
          m_upwards(shape.tip > shape.root),
          m_first(mesh.positions.size()),
          m_vertex(m_first),
          m_face(mesh.faces.size()),
          m_mesh(mesh) {
        const std::size_t vertex_count = m_first + vertices, face_count = m_face + faces;
        mesh.positions.resize(vertex_count);
        mesh.height.resize(vertex_count);
        mesh.thorn.resize(vertex_count);
        mesh.tissue.resize(vertex_count, shape.tissue);
        mesh.bundle.resize(vertex_count, shape.bundle);
        mesh.faces.resize(face_count);
        mesh.parts.resize(face_count, Part::Thorns);
        mesh.corner_uvs.resize(face_count);
    }

    std::int32_t add(const Vector2f& place, float z) {
        const std::size_t v = m_vertex++;
        m_mesh.positions[v] = {place.x(), place.y(), z};
        m_mesh.height[v] = z;
        m_mesh.thorn[v] = std::max(0.0F, (z - m_surface) * m_over_length);
        return static_cast<std::int32_t>(v);
    }

    /// A face, counter-clockwise from outside on the stub.
    void face(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
        if (!m_upwards) {
            std::swap(a, d);
            std::swap(b, c);
        }
        m_mesh.faces[m_face] = {a, b, c, d};
        m_mesh.corner_uvs[m_face++] = {uv_of(a), uv_of(b), uv_of(c), uv_of(d)};
    }
    void face(std::int32_t a, std::int32_t b, std::int32_t c) {
        if (!m_upwards) std::swap(a, c);
        m_mesh.faces[m_face] = {a, b, c, kNoVertex};
        m_mesh.corner_uvs[m_face++] = {uv_of(a), uv_of(b), uv_of(c), Vector2f(0, 0)};
    }

  private:
    /// Along the fibre: its number around over four, and height in units of 2 pi radii as on walls and bark.
    Vector2f uv_of(std::int32_t v) const {
        const auto i = static_cast<std::size_t>(v);
        return {0.25F * static_cast<float>((i - m_first) & 3U), m_mesh.height[i] * (1 / kTwoPi<float>)};
    }

    float m_surface, m_over_length;
    bool m_upwards;
    std::size_t m_first, m_vertex, m_face;
    BranchMesh& m_mesh;
};

/// Random number 0 .. 1 of a thorn.
float drawn(const ThornShape& shape, std::uint32_t which) {
    return unit_float(mixed_bits(shape.shape + 0x9e3779b9U * (which + 1)));
}

}  // namespace

void add_thorn(const ThornShape& shape, BranchMesh& mesh) {
    Body body(shape, 8, 8, mesh);
    const auto& f = shape.footprint;
    const float pyramid = 0.5F + 0.3F * drawn(shape, 0);
    const float shoulder = shape.tip + pyramid * (shape.surface - shape.tip);
    std::array<std::int32_t, 4> low{};
    for (std::size_t k = 0; k < 4; ++k) low[k] = body.add(f[k], shape.root);
    // Two corners of the hexahedron meet in one of the pyramid's three. No corner is level with another.
    const auto level = [&](std::uint32_t which) {
        return shoulder + 0.2F * (drawn(shape, which) - 0.5F) * (shoulder - shape.surface);
    };
    const std::int32_t p = body.add(0.5F * (f[0] + f[3]), level(1));
    const std::int32_t q = body.add(f[1], level(2));
    const std::int32_t r = body.add(f[2], level(3));
    const float a = 0.15F + 0.5F * drawn(shape, 4), b = (1 - a) * (0.2F + 0.6F * drawn(shape, 5));
    const Vector2f apex = a * 0.5F * (f[0] + f[3]) + b * f[1] + (1 - a - b) * f[2];
    const std::int32_t top = body.add(apex, shape.tip);
    body.face(low[3], low[2], low[1], low[0]);
    body.face(low[0], low[1], q, p);
    body.face(low[1], low[2], r, q);
    body.face(low[2], low[3], p, r);
    body.face(low[3], low[0], p);
    body.face(p, q, top);
    body.face(q, r, top);
    body.face(r, p, top);
}

void add_strand(const ThornShape& shape, int segments, const Vector2f& bend, BranchMesh& mesh) {
    const auto count = static_cast<std::size_t>(4 * segments + 1);
    Body body(shape, count, count, mesh);  // a face for each point but the top, and the bottom
    const Vector2f centre =
        0.25F * (shape.footprint[0] + shape.footprint[1] + shape.footprint[2] + shape.footprint[3]);
    const float split = 0.2F + 0.3F * drawn(shape, 0);
    std::array<std::int32_t, 4> below{};
    for (int i = 0; i < segments; ++i) {
        const float along = static_cast<float>(i) / static_cast<float>(segments);
        const float width = along < split ? 1 : (1 - along) / (1 - split);
        std::array<std::int32_t, 4> row{};
        for (std::size_t k = 0; k < 4; ++k) {
            const float uneven = 1 - 0.25F * drawn(shape, static_cast<std::uint32_t>(4 * i) +
                                                              static_cast<std::uint32_t>(k) + 8);
            const Vector2f place = centre + along * along * bend;
            row[k] = body.add(place + width * (i == 0 ? 1 : uneven) * (shape.footprint[k] - centre),
                              shape.root + along * (shape.tip - shape.root));
        }
        if (i == 0)
            body.face(row[3], row[2], row[1], row[0]);
        else
            for (std::size_t k = 0; k < 4; ++k)
                body.face(below[k], below[(k + 1) & 3U], row[(k + 1) & 3U], row[k]);
        below = row;
    }
    const std::int32_t top = body.add(centre + bend, shape.tip);
    for (std::size_t k = 0; k < 4; ++k) body.face(below[k], below[(k + 1) & 3U], top);
}

}  // namespace windfall::fracture
