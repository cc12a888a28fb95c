#include "geometry/sphere_map_flow.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace windfall::geometry {

namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Time of a step, for a surface of unit area.
constexpr double kFlowStep = 0.01;
constexpr int kMostFlowSteps = 150;
constexpr double kLeastCotangent = 0.05, kLargestCotangent = 3;
/// Cosine between a triangle's normal and the ray through it: clearly star-shaped; after kPatientSteps
/// anything positive will do.
constexpr double kClearlyStar = 0.1, kBarelyStar = 1e-3;
constexpr int kPatientSteps = 20;

Vec3 twice_area(const std::vector<Vec3>& x, const Triangle& t) {
    return (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
}

/// Moves the area's centroid to the origin and scales the area to 1.
void normalise(std::vector<Vec3>& x, const std::vector<Triangle>& triangles) {
    Vec3 sum = Vec3::Zero();
    double area = 0;
    for (const Triangle& t : triangles) {
        const double a = twice_area(x, t).norm() / 2;
        area += a;
        sum += a * (x[t[0]] + x[t[1]] + x[t[2]]) / 3;
    }
    const Vec3 centroid = sum / area;
    const double scale = 1 / std::sqrt(area);
    for (Vec3& p : x) p = scale * (p - centroid);
}

struct Worst {
    double cosine = 1;
    std::size_t triangle = 0;
};

/// The triangle that faces the origin most.
Worst worst_seen(const std::vector<Vec3>& x, const std::vector<Triangle>& triangles) {
    Worst worst;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Vec3 area = twice_area(x, triangles[t]);
        const Vec3 centre = (x[triangles[t][0]] + x[triangles[t][1]] + x[triangles[t][2]]) / 3;
        const double scale = area.norm() * centre.norm();
        const double cosine = scale > 0 ? area.dot(centre) / scale : -1;
        if (cosine < worst.cosine) worst = {cosine, t};
    }
    return worst;
}

SparseMatrix stiffness_of(const TriangleSurface& surface) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(12 * surface.triangles.size());
    for (const Triangle& t : surface.triangles) {
        for (int k = 0; k < 3; ++k) {
            const std::int32_t i = t[k], j = t[(k + 1) % 3];
            const Vec3 a = surface.positions[i] - surface.positions[t[(k + 2) % 3]];
            const Vec3 b = surface.positions[j] - surface.positions[t[(k + 2) % 3]];
            const double cotangent = 0.5 * a.dot(b) / std::max(a.cross(b).norm(), 1e-300);
            const double w = std::clamp(cotangent, kLeastCotangent, kLargestCotangent);
            entries.emplace_back(i, j, -w);
            entries.emplace_back(j, i, -w);
            entries.emplace_back(i, i, w);
            entries.emplace_back(j, j, w);
        }
    }
    const auto count = static_cast<Eigen::Index>(surface.positions.size());
    SparseMatrix stiffness(count, count);
    stiffness.setFromTriplets(entries.begin(), entries.end());
    return stiffness;
}

/// Steps (M + dt L) x' = M x with the masses of the moment and the stiffness of the start.
class Flow {
  public:
    explicit Flow(const TriangleSurface& surface)
        : m_triangles(surface.triangles), m_stiffness(kFlowStep * stiffness_of(surface)) {
        m_solver.analyzePattern(m_stiffness);
    }
    void step(std::vector<Vec3>& x) {
        std::vector<double> mass(x.size(), 0);
        for (const Triangle& t : m_triangles)
            for (const std::int32_t v : t) mass[v] += twice_area(x, t).norm() / 6;
        SparseMatrix matrix = m_stiffness;
        Eigen::MatrixXd right(static_cast<Eigen::Index>(x.size()), 3);
        for (std::size_t v = 0; v < x.size(); ++v) {
            const auto row = static_cast<Eigen::Index>(v);
            matrix.coeffRef(row, row) += mass[v] + 1e-14;
            right.row(row) = mass[v] * x[v].transpose();
        }
        m_solver.factorize(matrix);
        const Eigen::MatrixXd result = m_solver.solve(right);
        for (std::size_t v = 0; v < x.size(); ++v)
            x[v] = result.row(static_cast<Eigen::Index>(v)).transpose();
    }

  private:
    const std::vector<Triangle>& m_triangles;
    SparseMatrix m_stiffness;
    Eigen::SimplicialLDLT<SparseMatrix> m_solver;
};

}  // namespace

std::vector<Vec3> flow_to_sphere(const TriangleSurface& surface) {
    std::vector<Vec3> x = surface.positions;
    normalise(x, surface.triangles);
    Worst worst = worst_seen(x, surface.triangles);
    if (worst.cosine <= kClearlyStar) {
        Flow flow(surface);
        for (int step = 1; step <= kMostFlowSteps; ++step) {
            flow.step(x);
            normalise(x, surface.triangles);
            worst = worst_seen(x, surface.triangles);
            if (worst.cosine > (step < kPatientSteps ? kClearlyStar : kBarelyStar)) break;
        }
    }
    if (!(worst.cosine > kBarelyStar)) {
        const Triangle& t = surface.triangles[worst.triangle];
        const Vec3 place = surface.positions[t[0]];
        throw InputError(
            fmt::format("the surface cannot be laid on a sphere: it still folds over near ({:.4g}, {:.4g}, "
                        "{:.4g}) m; make its faces there more even or smooth the shape",
                        place.x(), place.y(), place.z()));
    }
    for (Vec3& p : x) p.normalize();
    return x;
}

}  // namespace windfall::geometry
