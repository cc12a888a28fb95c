#include "geometry/layered_mesh.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"

namespace windfall::geometry {

LayerFractions graded_layers(int flesh_layers, int skin_layers, double growth) {
    LayerFractions fractions;
    double sum = 0;
    for (int k = 0; k < flesh_layers; ++k) {
        fractions.flesh.push_back(std::pow(growth, flesh_layers - 1 - k));
        sum += fractions.flesh.back();
    }
    for (double& fraction : fractions.flesh) fraction /= sum;
    fractions.skin.assign(skin_layers, 1.0 / skin_layers);
    return fractions;
}

double growth_for_outermost(int flesh_layers, double outermost) {
    double low = 1;
    double high = 4;
    for (int k = 0; k < 60; ++k) {
        const double growth = 0.5 * (low + high);
        (graded_layers(flesh_layers, 1, growth).flesh.back() > outermost ? low : high) = growth;
    }
    return 0.5 * (low + high);
}

std::vector<Vec3> LayeredMesh::level_positions(int level) const {
    std::vector<Vec3> positions(columns());
    for (std::size_t c = 0; c < positions.size(); ++c) positions[c] = node(c, level);
    return positions;
}

std::vector<Vec3> brick_directions(const BrickSurface& brick, const Vec3& half_extents) {
    std::vector<Vec3> directions(brick.vertex_count());
    for (std::size_t v = 0; v < directions.size(); ++v) {
        Vec3 point;
        for (int i = 0; i < 3; ++i)
            point[i] = std::tan(std::numbers::pi / 4 * (2.0 * brick.lattice[v][i] / brick.cells[i] - 1));
        directions[v] = point.normalized().cwiseProduct(half_extents).normalized();
    }
    return directions;
}

namespace {

/// Calls visit(corner, edge, edge, edge) for every corner of every hexahedron, the edges right-handed.
template <class Visit>
void for_each_corner(const LayeredMesh& mesh, const Visit& visit) {
    for (const Quad& quad : mesh.brick.quads) {
        for (int k = 0; k < mesh.layers; ++k) {
            for (int c = 0; c < 4; ++c) {
                const int next = (c + 1) % 4;
                const int previous = (c + 3) % 4;
                for (int level = k; level <= k + 1; ++level) {
                    const Vec3& corner = mesh.node(quad[c], level);
                    visit(corner, Vec3(mesh.node(quad[next], level) - corner),
                          Vec3(mesh.node(quad[previous], level) - corner),
                          Vec3(mesh.node(quad[c], k + 1) - mesh.node(quad[c], k)));
                }
            }
        }
    }
}

}  // namespace

WorstCorner worst_corner(const LayeredMesh& mesh) {
    WorstCorner worst;
    for_each_corner(mesh, [&](const Vec3& corner, const Vec3& a, const Vec3& b, const Vec3& along) {
        const double scaled = a.cross(b).dot(along) / std::max(a.norm() * b.norm() * along.norm(), 1e-300);
        if (scaled < worst.scaled_jacobian) worst = {scaled, corner};
    });
    return worst;
}

void check_corners(const LayeredMesh& mesh, const std::string& remedy) {
    for_each_corner(mesh, [&](const Vec3& corner, const Vec3& a, const Vec3& b, const Vec3& along) {
        if (a.cross(b).dot(along) <= 0)
            throw InputError(fmt::format("the mesh folds over near ({:.3g}, {:.3g}, {:.3g}) r_1: {}",
                                         corner.x(), corner.y(), corner.z(), remedy));
    });
}

LayeredMesh make_layered_mesh(const FruitShape& shape, double skin_thickness, const Lattice& cells,
                              const LayerFractions& fractions) {
    LayeredMesh mesh;
    mesh.brick = make_brick_surface(cells);
    mesh.layers = fractions.count();
    mesh.flesh_layers = static_cast<int>(fractions.flesh.size());
    mesh.directions = brick_directions(mesh.brick, shape.half_extents());
    mesh.outward = mesh.directions;
    mesh.base.resize(mesh.columns());
    mesh.nodes.resize(mesh.columns() * mesh.layers);
    for (std::size_t c = 0; c < mesh.columns(); ++c) {
        const Vec3& direction = mesh.directions[c];
        double radius = shape.stone_radius(direction);
        const double flesh = shape.flesh_radius(direction) - radius;
        mesh.base[c] = radius * direction;
        for (int k = 0; k < mesh.layers; ++k) {
            radius += k < mesh.flesh_layers ? fractions.flesh[k] * flesh
                                            : fractions.skin[k - mesh.flesh_layers] * skin_thickness;
            mesh.nodes[c * mesh.layers + k] = radius * direction;
        }
    }
    check_corners(mesh, "make the stone or the skin smaller there");
    return mesh;
}

EdgeStatistics edge_statistics(const std::vector<Vec3>& positions, const std::vector<Quad>& quads) {
    double sum = 0;
    double sum_log = 0;
    double sum_log_sq = 0;
    double smallest = std::numeric_limits<double>::infinity();
    double largest = 0;
    std::size_t count = 0;
    for (const Quad& quad : quads) {
        for (int c = 0; c < 4; ++c) {
            const double length = (positions[quad[(c + 1) % 4]] - positions[quad[c]]).norm();
            sum += length;
            sum_log += std::log(length);
            sum_log_sq += std::log(length) * std::log(length);
            smallest = std::min(smallest, length);
            largest = std::max(largest, length);
            ++count;
        }
    }
    EdgeStatistics result;
    result.mean = sum / count;
    result.smallest_over_mean = smallest / result.mean;
    result.largest_over_mean = largest / result.mean;
    result.deviation_of_log = std::sqrt(std::max(0.0, sum_log_sq / count - std::pow(sum_log / count, 2)));
    return result;
}

namespace {

std::vector<Vec3> surface_points(const FruitShape& shape, const BrickSurface& brick) {
    std::vector<Vec3> points = brick_directions(brick, shape.half_extents());
    for (Vec3& point : points) point *= shape.flesh_radius(point);
    return points;
}

/// Up to a fifth of a step is rounded down: a mesh 3 % coarser than asked for beats one of 1.3 times the
/// size. Large meshes take steps of 32, so that the multigrid's coarsest level stays small.
int cells_above(double n) {
    constexpr double kLarge = 128;
    constexpr int kMost = 512;
    if (!(n <= kMost))
        throw InputError(fmt::format(
            "elements small enough would need mesh.n = {:.0f}, more than {}: make fruit.skin_thickness, "
            "material.gamma or mesh.edge_over_te larger, or set mesh.n",
            n, kMost));
    const int step = n > kLarge ? 32 : 8;
    return std::max(8, step * static_cast<int>(std::ceil(n / step - 0.2)));
}

double best_elongation(const FruitShape& shape) {
    double best = 1;
    double least = std::numeric_limits<double>::infinity();
    for (const double elongation : {1.0, 1.25, 1.5, 2.0, 3.0}) {
        const BrickSurface brick = make_brick_surface({16, static_cast<int>(16 * elongation), 16});
        const double deviation = edge_statistics(surface_points(shape, brick), brick.quads).deviation_of_log;
        if (deviation < least * (1 - 1e-9)) {
            least = deviation;
            best = elongation;
        }
    }
    return best;
}

}  // namespace

int cells_for(double area, double edge, double elongation) {
    return cells_above(std::sqrt(area / (2 + 4 * elongation)) / edge);
}

Lattice brick_of(int n, double elongation) {
    const int step = n > 128 && n % 32 == 0 ? 32 : 8;
    return {n, std::max(step, step * static_cast<int>(std::lround(elongation * n / step))), n};
}

Lattice brick_for_n(const FruitShape& shape, int n, double elongation) {
    return brick_of(n, elongation > 0 ? elongation : best_elongation(shape));
}

Lattice brick_for_edge(const FruitShape& shape, double edge, double elongation) {
    const double m = elongation > 0 ? elongation : best_elongation(shape);
    const BrickSurface brick = make_brick_surface({32, static_cast<int>(32 * m), 32});
    const std::vector<Vec3> points = surface_points(shape, brick);
    double area = 0;
    for (const double a : vertex_areas(points, {brick.quads.begin(), brick.quads.end()})) area += a;
    return brick_of(cells_for(area, edge, m), m);
}

}  // namespace windfall::geometry
