#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "geometry/laid_brick.h"

namespace windfall::geometry {

namespace {

constexpr double kBendWeight = 0.15;
constexpr double kLongestMove = 0.4, kShortestMove = 1e-4;  // of an edge
constexpr std::size_t kVerticesPerTask = 64;

/// The quadrilaterals around each vertex, and vertices in colours that share no quadrilateral.
struct Surroundings {
    struct Corner {
        std::int32_t quad = 0;
        int corner = 0;
    };
    std::vector<std::vector<Corner>> corners;
    std::vector<std::vector<std::int32_t>> colours;

    explicit Surroundings(const BrickSurface& brick) : corners(brick.vertex_count()) {
        for (std::size_t q = 0; q < brick.quads.size(); ++q)
            for (int c = 0; c < 4; ++c)
                corners[brick.quads[q][c]].push_back({static_cast<std::int32_t>(q), c});
        std::vector<std::size_t> colour(corners.size(), corners.size());
        for (std::size_t v = 0; v < corners.size(); ++v) {
            std::vector<char> taken;
            for (const Corner& corner : corners[v])
                for (const std::int32_t w : brick.quads[corner.quad])
                    if (const std::size_t its = colour[w]; its < corners.size()) {
                        if (its >= taken.size()) taken.resize(its + 1, 0);
                        taken[its] = 1;
                    }
            const auto free = std::find(taken.begin(), taken.end(), 0) - taken.begin();
            colour[v] = static_cast<std::size_t>(free);
            if (colour[v] >= colours.size()) colours.resize(colour[v] + 1);
            colours[colour[v]].push_back(static_cast<std::int32_t>(v));
        }
    }
};

class Relaxation {
  public:
    Relaxation(const CurvedSurface& surface, LaidBrick& laid, double barrier)
        : m_surface(surface),
          m_laid(laid),
          m_around(laid.brick),
          m_edge(std::sqrt(surface.area() / static_cast<double>(laid.brick.quads.size()))),
          m_barrier_sq(barrier * barrier) {}

    /// Longest move of the sweep, in edges.
    double sweep(bool backward) {
        std::vector<double> moves(m_laid.spots.size(), 0);
        const std::size_t count = m_around.colours.size();
        for (std::size_t i = 0; i < count; ++i) {
            const auto& vertices = m_around.colours[backward ? count - 1 - i : i];
            parallel_blocks(vertices.size(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
                for (std::size_t k = begin; k < end; ++k) moves[vertices[k]] = moved(vertices[k]);
            });
        }
        return *std::max_element(moves.begin(), moves.end()) / m_edge;
    }

  private:
    double corner_energy(const Vec3& a, const Vec3& b, const Vec3& normal) const {
        const double scale = 1 / (m_edge * m_edge);
        const double area = a.cross(b).dot(normal) * scale;
        const double positive = 0.5 * (area + std::sqrt(area * area + m_barrier_sq));
        const double energy =
            0.25 * (a.squaredNorm() + b.squaredNorm()) * scale * (1 + 1 / (positive * positive));
        return energy * energy * energy;
    }

    /// Energy of the corners that a vertex at `p` takes part in.
    double energy(std::int32_t vertex, const Vec3& p, const Vec3& n) const {
        const auto weight = [](const Vec3& one, const Vec3& other) {
            return 1 + kBendWeight * (1 - one.dot(other));
        };
        double sum = 0;
        for (const auto& [q, c] : m_around.corners[vertex]) {
            const Quad& quad = m_laid.brick.quads[q];
            const SurfaceSpot& next = m_laid.spots[quad[(c + 1) % 4]];
            const SurfaceSpot& across = m_laid.spots[quad[(c + 2) % 4]];
            const SurfaceSpot& last = m_laid.spots[quad[(c + 3) % 4]];
            const Vec3 to_next = weight(n, next.normal) * (next.point - p);
            const Vec3 to_last = weight(n, last.normal) * (last.point - p);
            sum += corner_energy(to_next, to_last, n);
            sum += corner_energy(weight(next.normal, across.normal) * (across.point - next.point), -to_next,
                                 next.normal);
            sum += corner_energy(-to_last, weight(last.normal, across.normal) * (across.point - last.point),
                                 last.normal);
        }
        return sum;
    }

    /// Newton's step in the tangent plane, derivatives by differences; curvature made positive.
    Vec2 newton_step(std::int32_t vertex, const SurfaceSpot& spot, const Vec3& t1, const Vec3& t2,
                     double here) const {
        const double h = 1e-3 * m_edge;
        const auto at = [&](double x, double y) {
            return energy(vertex, spot.point + x * t1 + y * t2, spot.normal);
        };
        const double east = at(h, 0), west = at(-h, 0), north = at(0, h), south = at(0, -h);
        const double mixed = (at(h, h) - east - north + here) / (h * h);
        const Vec2 slope((east - west) / (2 * h), (north - south) / (2 * h));
        Eigen::Matrix2d curvature;
        curvature << (east - 2 * here + west) / (h * h), mixed, mixed, (north - 2 * here + south) / (h * h);
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
        eigen.computeDirect(curvature);
        const Vec2 values = eigen.eigenvalues().cwiseAbs();
        const Vec2 bounded = values.cwiseMax(1e-3 * values.maxCoeff() + 1e-12);
        const Vec2 along = eigen.eigenvectors().transpose() * slope;
        return -eigen.eigenvectors() * along.cwiseQuotient(bounded);
    }

    /// Moves one vertex; gives how far.
    double moved(std::int32_t vertex) {
        constexpr int kTrials = 5;
        constexpr double kShorten = 0.35;
        SurfaceSpot& spot = m_laid.spots[vertex];
        const Vec3 other = std::abs(spot.normal.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY();
        const Vec3 t1 = other.cross(spot.normal).normalized(), t2 = spot.normal.cross(t1);
        const double here = energy(vertex, spot.point, spot.normal);
        Vec2 step = newton_step(vertex, spot, t1, t2, here);
        const double length = step.norm();
        if (!(length > kShortestMove * m_edge)) return 0;
        step *= std::min(1.0, kLongestMove * m_edge / length);
        for (int trial = 0; trial < kTrials; ++trial, step *= kShorten) {
            const Vec3 wanted = spot.point + step.x() * t1 + step.y() * t2;
            const SurfaceSpot next = m_surface.nearest(wanted, spot.normal, 2 * step.norm() + 0.1 * m_edge);
            if (next.place.triangle < 0 || (next.point - spot.point).norm() > 2.5 * step.norm() ||
                next.normal.dot(spot.normal) < 0.2)
                continue;
            if (!(energy(vertex, next.point, next.normal) < here)) continue;
            const double move = (next.point - spot.point).norm();
            spot = next;
            return move;
        }
        return 0;
    }

    const CurvedSurface& m_surface;
    LaidBrick& m_laid;
    Surroundings m_around;
    double m_edge, m_barrier_sq;
};

}  // namespace

void relax(const CurvedSurface& surface, LaidBrick& laid, const RelaxSettings& settings) {
    constexpr double kAtRest = 3e-4;  // of an edge: a long brick evens out by many small moves
    Relaxation relaxation(surface, laid, settings.barrier);
    for (int sweep = 0; sweep < settings.sweeps; ++sweep)
        if (relaxation.sweep(sweep % 2 == 1) < kAtRest) return;
}

}  // namespace windfall::geometry
