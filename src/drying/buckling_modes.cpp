#include "drying/buckling_modes.h"

#include <Spectra/SymGEigsSolver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.h"
#include "drying/drying_path.h"
#include "drying/specimen.h"

namespace windfall::drying {

using geometry::LayeredMesh;
using geometry::Vec3;

namespace {

/// K0 x and K0^-1 x; the multigrid's finest matrix is K0.
class Stiffness {
  public:
    using Scalar = double;
    Stiffness(Multigrid& multigrid, ConjugateGradients& solver, const RunContext& context)
        : m_multigrid(multigrid),
          m_solver(solver),
          m_context(context),
          m_in(multigrid.vector_size()),
          m_out(multigrid.vector_size()) {}

    Eigen::Index rows() const { return static_cast<Eigen::Index>(m_in.size()); }
    Eigen::Index cols() const { return rows(); }

    void perform_op(const double* x, double* y) const {
        std::copy(x, x + m_in.size(), m_in.begin());
        m_multigrid.product(m_in.data(), m_out.data());
        std::copy(m_out.begin(), m_out.end(), y);
    }

    void solve(const double* x, double* y) const {
        // Lanczos tolerates an inexact inverse as long as it is far more exact than the modes have to be: on
        // the base case 1e-6 finds the same critical shrinkages to five digits in twice the time.
        constexpr double kTolerance = 1e-4;
        constexpr int kIterations = 400;
        std::copy(x, x + m_in.size(), m_in.begin());
        const LinearResult result = m_solver.solve(m_in, m_out, kTolerance, kIterations,
                                                   std::numeric_limits<double>::infinity(), m_context);
        if (result.status == LinearStatus::NotDefinite || result.status == LinearStatus::NegativeCurvature)
            throw RunError(
                "the fruit has buckled before the shrinkage that its buckling modes are linearised about: "
                "set a smaller "
                "imperfection.linearize_at");
        std::copy(m_out.begin(), m_out.end(), y);
    }

  private:
    Multigrid& m_multigrid;
    ConjugateGradients& m_solver;
    const RunContext& m_context;
    mutable AlignedArray<float> m_in, m_out;
};

/// (K0 - K1) x: what the tangent loses between the two equilibria.
class StiffnessLoss {
  public:
    using Scalar = double;
    StiffnessLoss(const Multigrid& at_start, const Multigrid& beyond)
        : m_at_start(at_start),
          m_beyond(beyond),
          m_in(at_start.vector_size()),
          m_start_product(at_start.vector_size()),
          m_beyond_product(at_start.vector_size()) {}

    Eigen::Index rows() const { return static_cast<Eigen::Index>(m_in.size()); }
    Eigen::Index cols() const { return rows(); }

    void perform_op(const double* x, double* y) const {
        std::copy(x, x + m_in.size(), m_in.begin());
        m_at_start.product(m_in.data(), m_start_product.data());
        m_beyond.product(m_in.data(), m_beyond_product.data());
        for (std::size_t i = 0; i < m_in.size(); ++i)
            y[i] = static_cast<double>(m_start_product[i]) - m_beyond_product[i];
    }

  private:
    const Multigrid& m_at_start;
    const Multigrid& m_beyond;
    mutable AlignedArray<float> m_in, m_start_product, m_beyond_product;
};

std::vector<Vec3> to_nodes(const Eigen::VectorXd& mode, const LayeredMesh& mesh, const ColumnOrder& order) {
    std::vector<Vec3> nodes(mesh.nodes.size());
    const auto layers = static_cast<std::size_t>(mesh.layers);
    const double scale = 1 / mode.cwiseAbs().maxCoeff();
    for (std::size_t c = 0; c < mesh.columns(); ++c)
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < layers; ++k)
                nodes[order.vertex_of_solver[c] * layers + k][static_cast<int>(i)] =
                    scale * mode[static_cast<Eigen::Index>((3 * c + i) * layers + k)];
    return nodes;
}

}  // namespace

BucklingModes find_buckling_modes(const LayeredMesh& mesh, const DryingParameters& parameters,
                                  const RunContext& context) {
    // The modes of a fruit lie close together, and separating them is most of the work; what they are for,
    // an imperfection or a critical shrinkage to three digits, does not need them apart.
    constexpr double kModeTolerance = 1e-2;
    constexpr int kRestarts = 30;
    const auto [start, beyond] = buckling_linearization(parameters);
    context.progress({"buckling modes", 0, 1, -1, fmt::format("linearising about shrinkage {:.3f}", start)});

    // The fundamental path is stable, so it needs no damping; the tangents should be those of true
    // equilibria.
    DryingParameters undamped = parameters;
    undamped.solver.viscosity = undamped.solver.late_viscosity = 0;
    undamped.solver.newton_tolerance = 0.01;
    DryingPath path(mesh, undamped);
    path.advance(start, context);
    const AlignedArray<double> at_start = path.state().displacements.front();
    path.advance(beyond, context);

    Multigrid beyond_multigrid(mesh.brick, mesh.layers, kernels(mesh.layers));
    Elasticity beyond_elasticity(mesh, path.moduli(), beyond_multigrid, path.flesh_stiffening(),
                                 path.fibres());
    beyond_elasticity.set_drying(path.drying_field_at(beyond));
    beyond_elasticity.assemble(path.state().displacements.front(), 1, 0);

    Elasticity& elasticity = path.elasticity();
    elasticity.set_drying(path.drying_field_at(start));
    elasticity.assemble(at_start, 1, 0);
    if (!elasticity.multigrid().set_up())
        throw RunError(
            fmt::format("the fruit has buckled before shrinkage {:.3f}: set a smaller "
                        "imperfection.linearize_at",
                        start));

    StiffnessLoss loss(elasticity.multigrid(), beyond_multigrid);
    Stiffness stiffness(elasticity.multigrid(), path.newton().linear_solver(), context);
    const auto wanted = static_cast<Eigen::Index>(parameters.imperfection.modes);
    const Eigen::Index basis = std::min<Eigen::Index>(stiffness.rows(), 2 * wanted + 32);
    Spectra::SymGEigsSolver<StiffnessLoss, Stiffness, Spectra::GEigsMode::RegularInverse> lanczos(
        loss, stiffness, wanted, basis);
    Eigen::VectorXd first(stiffness.rows());
    for (Eigen::Index i = 0; i < first.size(); ++i)
        first[i] = random_normal2(static_cast<std::uint64_t>(parameters.seed), RandomPurpose::LanczosStart,
                                  static_cast<std::uint64_t>(i))[0];
    lanczos.init(first.data());
    lanczos.compute(Spectra::SortRule::LargestAlge, kRestarts, kModeTolerance,
                    Spectra::SortRule::LargestAlge);

    BucklingModes result;
    const Eigen::VectorXd eigenvalues = lanczos.eigenvalues();
    const Eigen::MatrixXd eigenvectors = lanczos.eigenvectors();
    for (Eigen::Index m = 0; m < eigenvectors.cols(); ++m) {
        if (eigenvalues[m] <= 0) break;  // stiffens on the way: never buckles
        result.critical_shrinkage.push_back(start + (beyond - start) / eigenvalues[m]);
        result.modes.push_back(to_nodes(eigenvectors.col(m), mesh, elasticity.multigrid().order()));
        context.log(fmt::format("buckling mode {}: critical shrinkage {:.4f}", m + 1,
                                result.critical_shrinkage.back()));
    }
    if (result.modes.empty())
        throw RunError(
            "no buckling mode was found: take imperfection.kind = \"noise\", or a larger "
            "imperfection.linearize_at");
    return result;
}

}  // namespace windfall::drying
