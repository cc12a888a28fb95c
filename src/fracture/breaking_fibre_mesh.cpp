#include "fracture/breaking_fibre_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace windfall::fracture {

namespace {

constexpr int kSides = 5;

Tissue tissue_at(const TissueParameters& tissue, double radius) {
    if (radius <= tissue.pith) return Tissue::Pith;
    return radius <= tissue.pith + tissue.heartwood ? Tissue::Heartwood : Tissue::Sapwood;
}

/// Of the thickness at the root.
double tube_thickness(int node, double stretched, bool torn) {
    const double along = static_cast<double>(node) / (kHalfNodes - 1);
    const double neck = std::pow(along, 4) * (torn ? 0.9 : 0.55 * stretched);
    return (1 - 0.25 * along) * (1 - neck);
}

/// Centre of the root's cap, rings from root to tip, centre of the tip's cap.
void add_half(const std::array<Point, kHalfNodes>& nodes, double radius, double stretched, bool torn,
              double ground, std::vector<Vector3f>& positions) {
    const auto put = [&](const Point& p) {
        positions.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()),
                               static_cast<float>(std::max(p.z(), ground)));
    };
    const auto tangent = [&nodes](int n) {
        const Point along = nodes[static_cast<std::size_t>(std::min(n + 1, kHalfNodes - 1))] -
                            nodes[static_cast<std::size_t>(std::max(n - 1, 0))];
        const double length = along.norm();
        return length > 1e-12 ? Point(along / length) : point(0, 0, 1);
    };
    put(nodes.front());
    // The ring's first direction is carried along from the root without twist.
    const Point start = tangent(0);
    Point side = std::abs(start.x()) < 0.8 ? point(1, 0, 0) : point(0, 1, 0);
    for (int n = 0; n < kHalfNodes; ++n) {
        const Point along = tangent(n);
        Point across = side - side.dot(along) * along;
        if (across.norm() < 1e-6) across = cross(along, point(along.y(), along.z(), along.x()));
        side = across.normalized();
        const Point other = cross(along, side);
        const double r = radius * tube_thickness(n, stretched, torn);
        for (int s = 0; s < kSides; ++s) {
            const double angle = 2 * std::numbers::pi * s / kSides;
            put(nodes[static_cast<std::size_t>(n)] + r * (std::cos(angle) * side + std::sin(angle) * other));
        }
    }
    put(nodes.back());
}

/// Faces of one half whose vertices begin at `base`, in the order of `add_half`.
void add_faces(std::int32_t base, float length, BranchMesh& mesh) {
    const auto corner = [base](int ring, int side) { return base + 1 + ring * kSides + side % kSides; };
    const auto u = [](int side) { return static_cast<float>(side) / kSides; };
    const auto add = [&mesh](const geometry::Face& face, const std::array<Vector2f, 4>& uvs) {
        mesh.faces.push_back(face);
        mesh.corner_uvs.push_back(uvs);
        mesh.parts.push_back(Part::Fibres);
    };
    const std::int32_t tip = base + 1 + kHalfNodes * kSides;
    for (int s = 0; s < kSides; ++s) {
        add({base, corner(0, s + 1), corner(0, s), geometry::kNoVertex},
            {Vector2f(u(s), 0), Vector2f(u(s + 1), 0), Vector2f(u(s), 0), Vector2f(0, 0)});
        for (int n = 0; n + 1 < kHalfNodes; ++n) {
            const float v0 = length * static_cast<float>(n) / (kHalfNodes - 1);
            const float v1 = length * static_cast<float>(n + 1) / (kHalfNodes - 1);
            add({corner(n, s), corner(n, s + 1), corner(n + 1, s + 1), corner(n + 1, s)},
                {Vector2f(u(s), v0), Vector2f(u(s + 1), v0), Vector2f(u(s + 1), v1), Vector2f(u(s), v1)});
        }
        add({tip, corner(kHalfNodes - 1, s), corner(kHalfNodes - 1, s + 1), geometry::kNoVertex},
            {Vector2f(u(s), length), Vector2f(u(s), length), Vector2f(u(s + 1), length), Vector2f(0, 0)});
    }
}

}  // namespace

std::vector<Vector3f> fibre_positions(const BreakingFibres& fibres, double ground) {
    std::vector<Vector3f> positions;
    for (std::size_t i = 0; i < fibres.fibres().size(); ++i)
        for (std::size_t half = 0; half < 2; ++half)
            add_half(fibres.states[i].position[half], fibres.fibres()[i].radius, fibres.stretched(i),
                     fibres.states[i].torn_at >= 0, ground, positions);
    return positions;
}

BranchMesh fibre_mesh(const FractureParameters& parameters, const BreakingFibres& fibres) {
    BranchMesh mesh;
    mesh.positions = fibre_positions(fibres, -1e30);
    constexpr int kHalfVertices = kHalfNodes * kSides + 2;
    for (const BridgingFibre& fibre : fibres.fibres()) {
        const double radius = std::hypot(fibre.surface.x(), fibre.surface.y());
        for (std::size_t half = 0; half < 2; ++half) {
            add_faces(static_cast<std::int32_t>(mesh.height.size()), static_cast<float>(fibre.length[half]),
                      mesh);
            for (int v = 0; v < kHalfVertices; ++v) {
                const int ring = std::clamp((v - 1) / kSides, 0, kHalfNodes - 1);
                const double along = static_cast<double>(ring) / (kHalfNodes - 1);
                const double below = fibre.length[half] * (1 - along);
                mesh.height.push_back(static_cast<float>(fibre.surface.z() + (half == 0 ? -below : below)));
                mesh.thorn.push_back(static_cast<float>(along));
                mesh.tissue.push_back(tissue_at(parameters.tissue, radius));
                mesh.bundle.push_back(fibre.name);
            }
        }
    }
    compute_normals(mesh);
    return mesh;
}

}  // namespace windfall::fracture
