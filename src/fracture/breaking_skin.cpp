#include "fracture/breaking_skin.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>

#include "core/parallel.h"

namespace windfall::fracture {

namespace {

/// Discs on either side that a disc's motion is taken from: what knocks in one corner moves no surface much.
constexpr int kReach = 3;

Eigen::Vector3d space(const Point& p) { return p.head<3>(); }

/// Weights of the four discs about a place between the middle two, u of 0 to 1.
std::array<float, 4> spline_weights(double u) {
    const double v = 1 - u;
    return {static_cast<float>(v * v * v / 6), static_cast<float>((3 * u * u * u - 6 * u * u + 4) / 6),
            static_cast<float>((3 * v * v * v - 6 * v * v + 4) / 6), static_cast<float>(u * u * u / 6)};
}

}  // namespace

std::vector<DiscMotion> disc_motions(const BreakingLattice& lattice, const LatticeEnd& end,
                                     const Particles& particles) {
    std::vector<DiscMotion> motions;
    for (int k = end.first_level; k <= end.last_level; ++k) {
        const std::size_t begin = end.at(std::max(k - kReach, end.first_level), 0);
        const std::size_t past = end.at(std::min(k + kReach, end.last_level), 0) + end.columns;
        DiscMotion motion{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()};
        for (std::size_t i = begin; i < past; ++i) {
            motion.rest_centre += space(lattice.particles.position[i]);
            motion.centre += space(particles.position[i]);
        }
        motion.rest_centre /= static_cast<double>(past - begin);
        motion.centre /= static_cast<double>(past - begin);
        Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
        for (std::size_t i = begin; i < past; ++i)
            covariance += (space(particles.position[i]) - motion.centre) *
                          (space(lattice.particles.position[i]) - motion.rest_centre).transpose();
        const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
        Eigen::Matrix3d u = svd.matrixU();
        if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) *= -1;
        motion.turn = u * svd.matrixV().transpose();
        motions.push_back(motion);
    }
    return motions;
}

LatticeSkin::LatticeSkin(const BreakingLattice& lattice, const LatticeEnd& end,
                         std::span<const float> unplaced_heights, std::vector<Vector3f> rest)
    : m_rest(std::move(rest)) {
    const auto first = lattice.levels.begin() + end.first_level,
               last = lattice.levels.begin() + end.last_level;
    const int discs = end.last_level - end.first_level;
    for (float z : unplaced_heights) {
        const auto above = std::upper_bound(first, last + 1, static_cast<double>(z));
        const int k = std::clamp(static_cast<int>(above - first) - 1, 0, discs - 1);
        const double low = *(first + k), high = *(first + k + 1);
        m_weights.push_back(spline_weights(std::clamp((z - low) / (high - low), 0.0, 1.0)));
        std::array<std::int32_t, 4> around{};
        for (int i = 0; i < 4; ++i) around[static_cast<std::size_t>(i)] = std::clamp(k - 1 + i, 0, discs);
        m_discs.push_back(around);
    }
}

std::vector<Vector3f> LatticeSkin::positions(const BreakingLattice& lattice,
                                             const std::vector<DiscMotion>& motions) const {
    const auto ground = static_cast<float>(lattice.ground);
    std::vector<Vector3f> result(m_rest.size());
    parallel_blocks(m_rest.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            const Eigen::Vector3d rest = m_rest[v].cast<double>();
            Eigen::Vector3d moved = Eigen::Vector3d::Zero();
            for (std::size_t i = 0; i < 4; ++i) {
                const DiscMotion& disc = motions[static_cast<std::size_t>(m_discs[v][i])];
                moved += m_weights[v][i] * (disc.centre + disc.turn * (rest - disc.rest_centre) - rest);
            }
            result[v] = (rest + moved).cast<float>();
            result[v].z() = std::max(result[v].z(), ground);
        }
    });
    return result;
}

}  // namespace windfall::fracture
