// The whole way of a fruit through its bifurcation, beside a plain twin that goes through the same
// increments: plain elements in double precision, a direct solver, Newton's method with a line search. No
// kernels, no multigrid, no conjugate gradients, no trust region, no predictor.
#include <gtest/gtest.h>

#include <Eigen/Sparse>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "drying/drying_path.h"
#include "drying/imperfection.h"
#include "drying/specimen.h"
#include "support/plain_elements.h"

namespace windfall::drying {
namespace {

class PlainTwin {
  public:
    PlainTwin(DryingPath& path, double viscosity, double end)
        : m_mesh(path.mesh()),
          m_order(path.elasticity().multigrid().order()),
          m_moduli(path.moduli()),
          m_mass(static_cast<Eigen::Index>(path.elasticity().size())),
          m_viscosity(viscosity),
          m_end(end),
          m_displacement(path.elasticity().size()) {
        const auto layers = static_cast<std::size_t>(m_mesh.layers);
        for (std::size_t i = 0; i < m_displacement.size(); ++i)
            m_mass[static_cast<Eigen::Index>(i)] =
                path.elasticity().mass()[i / (3 * layers) * layers + i % layers];
    }

    /// Minimises the incremental potential of drying.md from where the twin is; `drying` is that at the end.
    void advance(double step, const DryingField& drying) {
        const AlignedArray<double> from = m_displacement;
        const double factor = m_viscosity * m_end / step;
        System now = system(m_displacement, from, drying, factor, true);
        for (int iteration = 0; now.gradient.norm() > kTolerance; ++iteration) {
            if (iteration == kMostSteps) throw std::runtime_error("the twin does not converge");
            const Eigen::VectorXd way = descent(now);
            double length = 1;
            const double slope = way.dot(now.gradient);
            AlignedArray<double> trial(m_displacement.size());
            for (;; length /= 2) {
                if (length < 1e-10) throw std::runtime_error("the twin's way does not go down");
                for (std::size_t i = 0; i < trial.size(); ++i)
                    trial[i] = m_displacement[i] + length * way[static_cast<Eigen::Index>(i)];
                const double potential = system(trial, from, drying, factor, false).potential;
                // Rounding of the potential shall not refuse the last steps.
                if (potential <= now.potential + 1e-4 * length * slope + 1e-13 * std::abs(now.potential))
                    break;
            }
            m_displacement = trial;
            now = system(m_displacement, from, drying, factor, true);
        }
        m_energy = now.energy;
    }

    const AlignedArray<double>& displacement() const { return m_displacement; }
    double energy() const { return m_energy; }

  private:
    static constexpr int kMostSteps = 100;
    static constexpr double kLargestShift = 1e12;
    static constexpr double kTolerance = 1e-7;  // C0 r_1^2; forces of wrinkles are some 1e-2

    struct System {
        double potential = 0, energy = 0;
        Eigen::VectorXd gradient;
        Eigen::SparseMatrix<double> hessian;
    };

    System system(const AlignedArray<double>& u, const AlignedArray<double>& from, const DryingField& drying,
                  double factor, bool derivatives) const {
        const auto size = static_cast<Eigen::Index>(u.size());
        System result{0, 0, Eigen::VectorXd::Zero(size), {}};
        std::vector<Eigen::Triplet<double>> entries;
        bool sound = true;
        const auto material = [&](std::size_t q, int k) {
            return HexMaterial{m_moduli.shear[k], m_moduli.bulk[k], drying(q, k)};
        };
        const auto add = [&](const HexResponse& response, const test::ElementUnknowns& unknowns) {
            sound = sound && std::isfinite(response.energy);
            result.energy += response.energy;
            for (int i = 0; derivatives && i < 24; ++i) {
                if (unknowns[i] < 0) continue;
                result.gradient[unknowns[i]] += response.gradient[i];
                for (int j = 0; j < 24; ++j)
                    if (unknowns[j] >= 0)
                        entries.emplace_back(static_cast<int>(unknowns[i]), static_cast<int>(unknowns[j]),
                                             response.hessian(i, j));
            }
        };
        test::visit_plain_elements(m_mesh, m_order, u, material, add);
        result.potential = sound ? result.energy : std::numeric_limits<double>::infinity();
        for (Eigen::Index i = 0; i < size; ++i) {
            const double motion = u[static_cast<std::size_t>(i)] - from[static_cast<std::size_t>(i)];
            result.potential += factor / 2 * m_mass[i] * motion * motion;
            if (!derivatives) continue;
            result.gradient[i] += factor * m_mass[i] * motion;
            entries.emplace_back(static_cast<int>(i), static_cast<int>(i), factor * m_mass[i]);
        }
        if (!derivatives) return result;
        result.hessian.resize(size, size);
        result.hessian.setFromTriplets(entries.begin(), entries.end());
        return result;
    }

    /// Newton's step, with as much mass added to the matrix as makes it positive definite.
    Eigen::VectorXd descent(const System& now) {
        for (double shift = 0; shift < kLargestShift; shift = std::max(10.0, 4 * shift)) {
            Eigen::SparseMatrix<double> matrix = now.hessian;
            for (Eigen::Index i = 0; i < m_mass.size(); ++i) matrix.coeffRef(i, i) += shift * m_mass[i];
            if (!m_analysed) m_solver.analyzePattern(matrix);
            m_analysed = true;
            m_solver.factorize(matrix);
            if (m_solver.info() == Eigen::Success) return -m_solver.solve(now.gradient);
        }
        throw std::runtime_error("the twin's matrix is not finite");
    }

    const geometry::LayeredMesh& m_mesh;
    const ColumnOrder& m_order;
    LayerModuli m_moduli;
    Eigen::VectorXd m_mass;
    double m_viscosity, m_end;
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> m_solver;
    bool m_analysed = false;
    AlignedArray<double> m_displacement;
    double m_energy = 0;
};

double root_mean_square(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(PlainTwin, GoesTheSameWayThroughTheBifurcation) {
    DryingParameters p;
    p.fruit.skin_thickness = 0.12;
    p.material.gamma = 25;
    p.drying.shrinkage = 0.2;
    // One viscosity throughout, and wrinkles so long that there is no drift: the potential is the paper's.
    p.solver.late_viscosity = p.solver.viscosity;
    p.solver.newton_tolerance = 1e-3;
    ASSERT_GT(expected_wave_length(p), 1);
    // Six cells a side: a direct solver takes a second for each of some hundred steps.
    geometry::LayeredMesh mesh = geometry::make_layered_mesh(*make_shape(p.fruit), p.fruit.skin_thickness,
                                                             {6, 6, 6}, geometry::graded_layers(6, 2, 1.2));
    add_imperfection(mesh, p, {});

    DryingPath path(mesh, p);
    DryingPath measure(mesh, p);  // of the twin
    PlainTwin twin(path, p.solver.viscosity, p.drying.shrinkage);
    double before = 0, depth_before = 0, onset = -1;
    const auto follow = [&] {
        twin.advance(path.shrinkage() - before, path.drying_field());
        PathState state;
        state.course = path.state().course;
        state.displacements.push_back(twin.displacement());
        measure.set_state(std::move(state));
        const double its = root_mean_square(measure.skin_depth()) / p.fruit.skin_thickness;
        const double own = root_mean_square(path.skin_depth()) / p.fruit.skin_thickness;
        EXPECT_NEAR(own, its, 1e-3 * its) << path.shrinkage();
        if (onset < 0 && its > 0.1)
            onset = std::lerp(before, path.shrinkage(), (0.1 - depth_before) / (its - depth_before));
        before = path.shrinkage();
        depth_before = its;
    };
    path.advance(0.14, {}, follow);
    ASSERT_GT(onset, 0) << "the test must pass the bifurcation to mean anything";
    EXPECT_NEAR(path.onset(), onset, 2e-3 * onset);  // its depth is weighted by area
    EXPECT_GT(depth_before, 0.5);
    EXPECT_NEAR(path.state().history.back().elastic_energy, twin.energy(), 1e-6 * twin.energy());
    const std::vector<geometry::Vec3> own = path.positions(), its = measure.positions();
    double largest = 0;
    for (std::size_t i = 0; i < own.size(); ++i) largest = std::max(largest, (own[i] - its[i]).norm());
    EXPECT_LT(largest, 1e-3 * p.fruit.skin_thickness);
}

}  // namespace
}  // namespace windfall::drying
