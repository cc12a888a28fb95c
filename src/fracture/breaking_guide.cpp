#include "fracture/breaking_guide.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fracture/noise.h"

namespace windfall::fracture {

namespace {

constexpr double kSmoothing = 0.3;  // radii
/// From where above the hole's mouth a splinter is drawn to it, to where below it stays in it altogether,
/// radii.
constexpr float kFree = -0.15F, kHeld = 0.2F;
/// Way out per height above the edge of the bark.
constexpr float kLean = 1.5F;
constexpr int kEdgeSteps = 180, kEdgeReach = 3;  // around; neighbours whose teeth count

/// Step of the table of the edge at an angle, or some steps beside it.
std::size_t edge_step(float angle, int beside) {
    const auto step =
        static_cast<int>(std::floor(angle / (2 * std::numbers::pi_v<float>)*kEdgeSteps)) + beside;
    return static_cast<std::size_t>((step % kEdgeSteps + kEdgeSteps) % kEdgeSteps);
}

}  // namespace

std::vector<double> smoothed_heights(const BreakingLattice& lattice) {
    const DiscPlan& plan = lattice.plan;
    std::vector<double> result(plan.size(), 0.0);
    for (std::size_t c = 0; c < plan.size(); ++c) {
        double weights = 0;
        for (std::size_t o = 0; o < plan.size(); ++o) {
            const double distance = std::hypot(plan.x(o) - plan.x(c), plan.y(o) - plan.y(c)) / kSmoothing;
            const double weight = plan.area(o) * std::exp(-distance * distance / 2);
            result[c] += weight * lattice.heights[o];
            weights += weight;
        }
        result[c] /= weights;
    }
    return result;
}

SplinterGuide::SplinterGuide(const BreakingLattice& lattice, const BreakEnds& ends, bool of_stub,
                             const std::vector<Vector3f>& rest)
    : m_sense(of_stub ? -1.0F : 1.0F) {
    // The bark holds what is below its highest (for the stub, above its lowest) teeth thereabouts.
    constexpr float kNone = -1e30F;
    std::vector<float> edge(kEdgeSteps, kNone);
    for (const RimVertex& rim : ends.rim) {
        const float z = ends.stub.positions[static_cast<std::size_t>(rim.vertex)].z();
        for (int i = -kEdgeReach; i <= kEdgeReach; ++i) {
            float& at = edge[edge_step(rim.angle, i)];
            at = std::max(at, m_sense * z);
        }
    }
    const float fallback = *std::max_element(edge.begin(), edge.end());
    for (float at : edge) m_edge.push_back(m_sense * (at == kNone ? fallback : at));

    const std::vector<double> mouths = smoothed_heights(lattice);
    const std::vector<Vector3f>& unplaced = of_stub ? ends.stub.positions : ends.piece.positions;
    for (std::size_t v = 0; v < rest.size(); ++v) {
        const Vector3f& p = unplaced[v];
        const auto mouth = static_cast<float>(lattice.plan.interpolate(mouths, p.x(), p.y()));
        const float reach = std::max(m_sense * mouth, m_sense * edge_at(p.x(), p.y()));
        if (reach - m_sense * p.z() > kFree) m_splinters.push_back({v, mouth, p.z() - rest[v].z(), rest[v]});
    }
}

float SplinterGuide::edge_at(float x, float y) const { return m_edge[edge_step(std::atan2(y, x), 0)]; }

double SplinterGuide::held(double depth) { return smooth_step(kFree, kHeld, static_cast<float>(depth)); }

void SplinterGuide::apply(const DiscMotion& other, double share, std::vector<Vector3f>& positions) const {
    if (share <= 0) return;
    const Eigen::Matrix3f turn = other.turn.cast<float>();
    const Vector3f centre = other.centre.cast<float>(), rest_centre = other.rest_centre.cast<float>();
    for (const Splinter& splinter : m_splinters) {
        // Where the vertex would be, were the other end still at rest.
        const Vector3f local = rest_centre + turn.transpose() * (positions[splinter.vertex] - centre);
        const float height = local.z() + splinter.lowered;
        const Vector3f back(splinter.rest.x() - local.x(), splinter.rest.y() - local.y(), 0);
        Vector3f wanted = local + static_cast<float>(held(m_sense * (splinter.mouth - height))) * back;
        // Above the edge of the bark it may lean out over it.
        const float above = m_sense * (height - edge_at(wanted.x(), wanted.y()));
        const float radius = wanted.head<2>().norm();
        const float most = splinter.rest.head<2>().norm() + kLean * std::max(0.0F, above);
        if (radius > most) wanted.head<2>() *= most / radius;
        positions[splinter.vertex] += static_cast<float>(share) * (turn * (wanted - local));
    }
}

}  // namespace windfall::fracture
