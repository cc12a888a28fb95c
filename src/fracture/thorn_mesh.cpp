#include "fracture/thorn_mesh.h"

#include <numbers>

#include "fracture/noise.h"

namespace windfall::fracture {
namespace {

using geometry::kNoVertex;

/// Adds rows of points from the root to the tip and the faces between them; on the piece, where the tip is
/// below, all faces turn round.
class Body {
  public:
    Body(const ThornShape& shape, BranchMesh& mesh)
        : m_shape(shape), m_mesh(mesh), m_first(static_cast<std::int32_t>(mesh.positions.size())) {}

    std::int32_t add(const Vector2f& place, float z) {
        m_mesh.positions.emplace_back(place.x(), place.y(), z);
        m_mesh.height.push_back(z);
        const float along = (z - m_shape.surface) / (m_shape.tip - m_shape.surface);
        m_mesh.thorn.push_back(along < 0 ? 0.0F : along);
        m_mesh.tissue.push_back(m_shape.tissue);
        m_mesh.bundle.push_back(m_shape.bundle);
        return static_cast<std::int32_t>(m_mesh.positions.size()) - 1;
    }

    /// A face, counter-clockwise from outside on the stub.
    void face(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d = kNoVertex) {
        const bool upwards = m_shape.tip > m_shape.root;
        if (d == kNoVertex)
            m_mesh.faces.push_back(upwards ? geometry::Face{a, b, c, d} : geometry::Face{c, b, a, d});
        else
            m_mesh.faces.push_back(upwards ? geometry::Face{a, b, c, d} : geometry::Face{d, c, b, a});
        m_mesh.parts.push_back(Part::Thorns);
        std::array<Vector2f, 4> uv;
        for (std::size_t k = 0; k < 4; ++k) uv[k] = uv_of(m_mesh.faces.back()[k]);
        m_mesh.corner_uvs.push_back(uv);
    }

  private:
    /// Along the fibre: its number around over four, and height in units of 2 pi radii as on walls and bark.
    Vector2f uv_of(std::int32_t v) const {
        if (v == kNoVertex) return Vector2f::Zero();
        return {0.25F * static_cast<float>((v - m_first) % 4),
                m_mesh.positions[static_cast<std::size_t>(v)].z() / (2 * std::numbers::pi_v<float>)};
    }

    const ThornShape& m_shape;
    BranchMesh& m_mesh;
    std::int32_t m_first;
};

/// Random number 0 .. 1 of a thorn.
float drawn(const ThornShape& shape, std::uint32_t which) {
    return unit_float(mixed_bits(shape.shape + 0x9e3779b9U * (which + 1)));
}

}  // namespace

void add_thorn(const ThornShape& shape, BranchMesh& mesh) {
    Body body(shape, mesh);
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
    Body body(shape, mesh);
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
