#include "drying/skin_contact.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"

namespace windfall::drying {

using geometry::Vec3;

namespace {

constexpr std::size_t kPairBlock = 512;
constexpr double kShareOfPair = 1.0 / 24;  // of a pair's area; measured, see the header
constexpr double kShareOfHeight = 0.3;     // gap over the smallest height of a fresh triangle, at most
constexpr double kAllowance = 1;  // of the gap: how far vertices move before pairs are looked for again
constexpr double kMotionReserve = 1.25;  // over the motion that pairs are looked for
constexpr double kSmallestScale = 0.9;   // of the skin since pairs were looked for
/// Share of the contact's own blocks that the preconditioner sees.
constexpr float kPreconditioned = 0.25F;

/// Derivatives of the energy over area, stiffness and share.
struct Barrier {
    double value, slope, curvature;
    Barrier(double distance, double gap) {
        const double y = distance / gap;
        const double log_y = std::log(y);
        const double open = 1 - y;
        value = -gap * open * open * log_y;
        slope = 2 * open * log_y - open * open / y;
        curvature = (-2 * log_y + 4 * open / y + open * open / (y * y)) / gap;
    }
};

FourPoints corners_of(const ContactPair& pair, const std::vector<Vec3>& x) {
    return {x[pair.vertices[0]], x[pair.vertices[1]], x[pair.vertices[2]], x[pair.vertices[3]]};
}

std::vector<Vec3> fresh_skin(const geometry::LayeredMesh& mesh, const ColumnOrder& order) {
    std::vector<Vec3> result;
    for (const std::int32_t vertex : order.vertex_of_solver) result.push_back(mesh.node(vertex, mesh.layers));
    return result;
}

/// The factor that takes anchors nearest to positions.
double common_scale(const std::vector<Vec3>& anchors, const std::vector<Vec3>& positions) {
    double dot = 0;
    double square = 0;
    for (std::size_t v = 0; v < anchors.size(); ++v) {
        dot += anchors[v].dot(positions[v]);
        square += anchors[v].squaredNorm();
    }
    return dot / square;
}

}  // namespace

SkinContact::SkinContact(const geometry::LayeredMesh& mesh, const ColumnOrder& order, double gap,
                         double stiffness)
    : m_layers(static_cast<std::size_t>(mesh.layers)),
      m_surface(fresh_skin(mesh, order), order.quads),
      m_gap(std::min(gap, kShareOfHeight * m_surface.smallest_height())),
      m_stiffness(stiffness) {}

std::vector<Vec3> SkinContact::positions(const AlignedArray<double>& displacement) const {
    std::vector<Vec3> result = m_surface.fresh;
    for (std::size_t v = 0; v < result.size(); ++v)
        for (std::size_t i = 0; i < 3; ++i)
            result[v][static_cast<int>(i)] +=
                displacement[place(static_cast<std::int32_t>(v)) + i * m_layers];
    return result;
}

bool SkinContact::covers(const std::vector<Vec3>& positions) const {
    if (m_anchors.empty()) return false;
    const double scale = common_scale(m_anchors, positions);
    if (!(scale >= kSmallestScale)) return false;
    for (std::size_t v = 0; v < positions.size(); ++v)
        if (!((positions[v] / scale - m_anchors[v]).squaredNorm() <= m_allowances[v] * m_allowances[v]))
            return false;
    return true;
}

void SkinContact::find_pairs(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
    if (covers(from) && covers(to)) return;
    // On the straight way x / scale stays between its ends, so that what covers both covers all of it.
    const double scale = common_scale(from, to);
    if (!std::isfinite(scale))
        throw RunError("a skin with positions that are not finite was checked for contact");
    m_anchors = from;
    m_allowances.resize(from.size());
    for (std::size_t v = 0; v < from.size(); ++v)
        m_allowances[v] = kAllowance * m_gap + kMotionReserve * (to[v] / scale - from[v]).norm();
    const double smallest_scale = std::min(scale, kSmallestScale);
    m_pairs = find_contact_pairs(m_surface, from, m_gap / smallest_scale, m_allowances);
}

std::vector<SkinContact::Press> SkinContact::presses(const std::vector<Vec3>& x) const {
    std::vector<std::vector<Press>> found((m_pairs.size() + kPairBlock - 1) / kPairBlock);
    parallel_blocks(m_pairs.size(), kPairBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const ContactPair& pair = m_pairs[i];
            const FourPoints points = corners_of(pair, x);
            const ContactGap gap = contact_gap(pair.kind, points);
            if (!(gap.distance < m_gap)) continue;
            Press press{&pair, gap, {}};
            if (pair.kind == ContactKind::EdgeEdge) {
                const FourPoints fresh = corners_of(pair, m_surface.fresh);
                press.mollifier = edge_mollifier(
                    points, (fresh[1] - fresh[0]).squaredNorm() * (fresh[3] - fresh[2]).squaredNorm());
            }
            found[begin / kPairBlock].push_back(press);
        }
    });
    std::vector<Press> result;
    for (const auto& block : found) result.insert(result.end(), block.begin(), block.end());
    return result;
}

ContactEnergy SkinContact::energy(const AlignedArray<double>& displacement, AlignedArray<double>* force) {
    const std::vector<Vec3> x = positions(displacement);
    find_pairs(x, x);
    ContactEnergy result;
    for (const Press& press : presses(x)) {
        const double factor = kShareOfPair * m_stiffness * press.pair->area;
        const Barrier barrier(press.gap.distance, m_gap);
        result.energy += factor * press.mollifier.value * barrier.value;
        result.smallest_distance =
            result.pairs == 0 ? press.gap.distance : std::min(result.smallest_distance, press.gap.distance);
        ++result.pairs;
        if (force == nullptr) continue;
        for (std::size_t p = 0; p < 4; ++p) {
            const Vec3 gradient =
                factor * (press.mollifier.value * barrier.slope * press.gap.weights[p] * press.gap.normal +
                          barrier.value * press.mollifier.gradient[p]);
            for (std::size_t i = 0; i < 3; ++i)
                (*force)[place(press.pair->vertices[p]) + i * m_layers] += gradient[static_cast<int>(i)];
        }
    }
    return result;
}

double SkinContact::free_part(const AlignedArray<double>& from, const AlignedArray<double>& to) {
    const std::vector<Vec3> x = positions(from);
    std::vector<Vec3> motion = positions(to);
    find_pairs(x, motion);
    for (std::size_t v = 0; v < x.size(); ++v) motion[v] -= x[v];
    std::vector<double> smallest((m_pairs.size() + kPairBlock - 1) / kPairBlock, 1);
    parallel_blocks(m_pairs.size(), kPairBlock, [&](std::size_t begin, std::size_t end) {
        double& own = smallest[begin / kPairBlock];
        for (std::size_t i = begin; i < end; ++i)
            own = std::min(own, free_part_of_way(m_pairs[i].kind, corners_of(m_pairs[i], x),
                                                 corners_of(m_pairs[i], motion), m_gap));
    });
    return smallest.empty() ? 1 : *std::min_element(smallest.begin(), smallest.end());
}

void SkinContact::linearize(const AlignedArray<double>& displacement) {
    const std::vector<Vec3> x = positions(displacement);
    find_pairs(x, x);
    m_terms.clear();
    for (const Press& press : presses(x)) {
        const Barrier barrier(press.gap.distance, m_gap);
        const double root = std::sqrt(kShareOfPair * m_stiffness * press.pair->area * press.mollifier.value *
                                      barrier.curvature);
        Term term{press.pair->vertices, {}};
        for (std::size_t p = 0; p < 4; ++p)
            for (std::size_t i = 0; i < 3; ++i)
                term.direction[3 * p + i] =
                    static_cast<float>(root * press.gap.weights[p] * press.gap.normal[static_cast<int>(i)]);
        m_terms.push_back(term);
    }
}

void SkinContact::add_to_diagonal(const MatrixArrays& matrix) const {
    for (const Term& term : m_terms)
        for (std::size_t p = 0; p < 4; ++p) {
            float* block =
                matrix.diagonal + (static_cast<std::size_t>(term.vertices[p]) * 18 + 10) * m_layers - 1;
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j)
                    block[(3 * i + j) * m_layers] +=
                        kPreconditioned * term.direction[3 * p + i] * term.direction[3 * p + j];
        }
}

double SkinContact::add_product(const float* x, float* y) const {
    double inner = 0;
    for (const Term& term : m_terms) {
        std::array<float, 4> along{};
        for (std::size_t p = 0; p < 4; ++p)
            for (std::size_t i = 0; i < 3; ++i)
                along[p] += term.direction[3 * p + i] * x[place(term.vertices[p]) + i * m_layers];
        const float sum = (along[0] + along[1]) + (along[2] + along[3]);
        for (std::size_t p = 0; p < 4; ++p) {
            const float rest = sum - kPreconditioned * along[p];
            for (std::size_t i = 0; i < 3; ++i)
                y[place(term.vertices[p]) + i * m_layers] += rest * term.direction[3 * p + i];
            inner += rest * along[p];
        }
    }
    return inner;
}

}  // namespace windfall::drying
