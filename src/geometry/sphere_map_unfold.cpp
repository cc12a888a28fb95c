#include "geometry/sphere_map_unfold.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace windfall::geometry {

namespace {

using Eigen::Matrix3d;

/// Weight of keeping volumes against keeping angles.
constexpr double kVolumeWeight = 0.5;
constexpr int kMostSteps = 300, kStepsOnceSound = 30;
constexpr double kLeastGain = 1e-5;
constexpr std::size_t kMemory = 8;
constexpr int kLineSearch = 24;

/// An element as the energy sees it: J = sum of node[i] gradient[i]^T.
struct Element {
    std::array<std::int32_t, 4> node{};
    std::array<Vec3, 4> gradient;
    double weight = 0;  ///< volume of the design
};

/// Energy of an element as a function of T = |J|^2 and D = det J, with its derivatives.
struct Energy {
    double value, d_t, d_d;
};

/// T / chi^(2/3) + weight (1 + D^2) / chi with chi = (D + sqrt(D^2 + eps^2)) / 2, which is positive
/// everywhere and tends to D.
Energy energy_of(double T, double D, double eps) {
    const double root = std::sqrt(D * D + eps * eps);
    // For D << 0 the sum would cancel.
    const double chi = D >= 0 ? 0.5 * (D + root) : 0.5 * eps * eps / (root - D);
    const double d_chi = chi / root;
    const double p = 1 / std::cbrt(chi * chi), q = 1 / chi;
    const double s = 1 + D * D;
    return {T * p + kVolumeWeight * s * q, p,
            -2.0 / 3 * T * p * q * d_chi + kVolumeWeight * (2 * D * q - s * q * q * d_chi)};
}

Matrix3d cofactor(const Matrix3d& J) {
    Matrix3d result;
    result.col(0) = J.col(1).cross(J.col(2));
    result.col(1) = J.col(2).cross(J.col(0));
    result.col(2) = J.col(0).cross(J.col(1));
    return result;
}

using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

double dot(const Points& a, const Points& b) { return a.cwiseProduct(b).sum(); }

class Unfolding {
  public:
    Unfolding(const std::vector<Vec3>& nodes, std::size_t free, const std::vector<DesignedElement>& designed)
        : m_free(static_cast<Eigen::Index>(free)), m_nodes(nodes.size(), 3) {
        for (std::size_t i = 0; i < nodes.size(); ++i)
            m_nodes.row(static_cast<Eigen::Index>(i)) = nodes[i].transpose();
        double designed_volume = 0, volume = 0;
        for (const auto& d : designed) {
            designed_volume += d.design.determinant();
            volume += edges_of(d.node).determinant();
        }
        const double scale = std::cbrt(volume / designed_volume);
        for (const auto& d : designed) {
            Element element;
            element.node = d.node;
            const Matrix3d inverse = (scale * d.design).inverse();
            element.gradient[0] = -inverse.colwise().sum().transpose();
            for (int i = 0; i < 3; ++i) element.gradient[i + 1] = inverse.row(i).transpose();
            element.weight = d.design.determinant() / designed_volume;
            m_elements.push_back(element);
        }
        make_harmonic();
    }

    WorstElement worst() const { return worst_of(m_nodes); }

    /// L-BFGS with the Laplacian as first guess of the curvature (Liu, Bouaziz and Kavan 2017, Quasi-Newton
    /// methods for real-time simulation of hyperelastic materials).
    void descend() {
        int sound = 0;
        double least = worst().ratio;
        for (int step = 0; step < kMostSteps && sound < kStepsOnceSound; ++step) {
            // Wide while something is folded far, narrow near the end (eq. 4 and the paper's section 3.2).
            // The energy changes with it, and what was learnt of its curvature is lost.
            const double eps = std::sqrt(1e-12 + 0.04 * std::min(least, 0.0) * std::min(least, 0.0));
            if (step == 0 || eps < 0.7 * m_eps || eps > 1.4 * m_eps) forget(eps);
            const double before = m_energy;
            if (!take_step()) {
                if (m_steps.empty()) return;
                forget(m_eps);
            }
            least = worst().ratio;
            if (least <= 0) continue;
            if (m_energy > (1 - kLeastGain) * before) return;
            ++sound;
        }
    }

    void read(std::vector<Vec3>& nodes) const {
        for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = m_nodes.row(static_cast<Eigen::Index>(i));
    }

  private:
    struct Step {
        Points x, slope;
        double inverse_dot;
    };

    Matrix3d edges_of(const std::array<std::int32_t, 4>& node) const {
        Matrix3d edges;
        for (int i = 0; i < 3; ++i)
            edges.col(i) = (m_nodes.row(node[i + 1]) - m_nodes.row(node[0])).transpose();
        return edges;
    }
    static Matrix3d deformation(const Points& x, const Element& e) {
        Matrix3d J = x.row(e.node[0]).transpose() * e.gradient[0].transpose();
        for (int i = 1; i < 4; ++i) J += x.row(e.node[i]).transpose() * e.gradient[i].transpose();
        return J;
    }
    WorstElement worst_of(const Points& x) const {
        WorstElement worst{std::numeric_limits<double>::infinity(), 0};
        for (std::size_t e = 0; e < m_elements.size(); ++e) {
            const double ratio = deformation(x, m_elements[e]).determinant();
            if (ratio < worst.ratio) worst = {ratio, e};
        }
        return worst;
    }
    void make_harmonic() {
        std::vector<Eigen::Triplet<double>> entries;
        Points right = Points::Zero(m_free, 3);
        for (const Element& e : m_elements)
            for (int i = 0; i < 4; ++i) {
                if (e.node[i] >= m_free) continue;
                for (int j = 0; j < 4; ++j) {
                    const double k = e.weight * e.gradient[i].dot(e.gradient[j]);
                    if (e.node[j] < m_free)
                        entries.emplace_back(e.node[i], e.node[j], k);
                    else
                        right.row(e.node[i]) -= k * m_nodes.row(e.node[j]);
                }
            }
        Eigen::SparseMatrix<double> matrix(m_free, m_free);
        matrix.setFromTriplets(entries.begin(), entries.end());
        m_laplacian.compute(matrix);
        m_nodes.topRows(m_free) = m_laplacian.solve(right);
    }
    double energy_at(const Points& x, Points& slope) const {
        slope.setZero(m_nodes.rows(), 3);
        double sum = 0;
        for (const Element& e : m_elements) {
            const Matrix3d J = deformation(x, e);
            const Matrix3d cofactors = cofactor(J);
            const Energy f = energy_of(J.squaredNorm(), J.col(0).dot(cofactors.col(0)), m_eps);
            const Matrix3d stress = e.weight * (2 * f.d_t * J + f.d_d * cofactors);
            for (int i = 0; i < 4; ++i) slope.row(e.node[i]) += (stress * e.gradient[i]).transpose();
            sum += e.weight * f.value;
        }
        slope.conservativeResize(m_free, 3);
        return sum;
    }
    void forget(double eps) {
        m_steps.clear();
        m_eps = eps;
        m_energy = energy_at(m_nodes, m_slope);
    }
    Points direction() const {
        Points q = m_slope;
        std::vector<double> alpha(m_steps.size());
        for (std::size_t k = m_steps.size(); k-- > 0;) {
            alpha[k] = m_steps[k].inverse_dot * dot(m_steps[k].x, q);
            q -= alpha[k] * m_steps[k].slope;
        }
        Points d = m_laplacian.solve(q) / 2;
        for (std::size_t k = 0; k < m_steps.size(); ++k)
            d += (alpha[k] - m_steps[k].inverse_dot * dot(m_steps[k].slope, d)) * m_steps[k].x;
        return -d;
    }
    /// Gives whether the energy could be lowered.
    bool take_step() {
        const Points d = direction();
        const double descent = dot(m_slope, d);
        if (!(descent < 0)) return false;
        double share = 1;
        for (int k = 0; k < kLineSearch; ++k, share /= 2) {
            Points x = m_nodes;
            x.topRows(m_free) += share * d;
            Points slope;
            const double energy = energy_at(x, slope);
            if (!(energy < m_energy + 1e-4 * share * descent)) continue;
            Step step{share * d, slope - m_slope, 0};
            const double curvature = dot(step.x, step.slope);
            if (curvature > 0) {
                step.inverse_dot = 1 / curvature;
                m_steps.push_back(std::move(step));
                if (m_steps.size() > kMemory) m_steps.erase(m_steps.begin());
            }
            m_nodes = std::move(x);
            m_slope = std::move(slope);
            m_energy = energy;
            return true;
        }
        return false;
    }

    Eigen::Index m_free;
    Points m_nodes;
    std::vector<Element> m_elements;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> m_laplacian;
    double m_eps = 0, m_energy = 0;
    Points m_slope;
    std::vector<Step> m_steps;
};

}  // namespace

WorstElement unfold(std::vector<Vec3>& nodes, std::size_t free,
                    const std::vector<DesignedElement>& elements) {
    Unfolding unfolding(nodes, free, elements);
    unfolding.descend();
    unfolding.read(nodes);
    return unfolding.worst();
}

}  // namespace windfall::geometry
