#include "fracture/placing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fracture/break_buffers.h"
#include "fracture/noise.h"

namespace windfall::fracture {
namespace {

// Between the axes of the stub and of the piece beside it, in radii, for straight branches.
constexpr float kBeside = 2.7F;
// The deepest furrow over the relief (see BarkRelief).
constexpr double kDeepestFurrow = 1.4;
// What furrows may take of the distances along a ray, so that none turns round.
constexpr double kMostFurrowed = 0.7;
// How fast the relief changes with the angle, at bark_scale 1, over a fifth of a sector (the nodes' jitter)
// times the sectors; and how much of a cell it may take that way.
constexpr double kFurrowSlope = 38, kMostTwist = 0.4;
// Along the branch, from the break to the full relief, in radii.
constexpr float kFurrowFade = 0.5F;
constexpr double kLeastFurrowWidth = 0.02;

bool has_thorns(const FractureParameters& p) {
    const ThornParameters& t = p.thorns;
    return p.fringe.strands > 0 || p.ductile.probability > 0 || t.pith_probability > 0 ||
           t.heartwood_probability > 0 || t.sapwood_probability > 0 || t.phloem_probability > 0;
}

/// In cells that are much wider than high a strong outline would bend the holes of thorns more than the
/// thorns in them: there it is weaker. On lattices of about three sectors a ring it is as asked.
float outline_of(const FractureParameters& p) {
    const double outline = p.branch.outline;
    if (!has_thorns(p)) return static_cast<float>(outline);
    const double width = 2 * std::numbers::pi / static_cast<double>(p.branch.sectors);
    const double bend = kOutlineBend * width * width / 8 * static_cast<double>(p.branch.rings);  // cells
    return static_cast<float>(std::min(outline, kMostOutlineBend / bend));
}

}  // namespace

/// A few points at a time, an array for each coordinate, so that the noise becomes vector code.
struct LimbShape::Block {
    static constexpr std::size_t kSize = 256;
    std::array<float, kSize> x, y, z, scale;

    void set(std::size_t i, const Vector3f& p) {
        x[i] = p.x();
        y[i] = p.y();
        z[i] = p.z();
    }
};

LimbShape::LimbShape(const FractureParameters& p, double lowest, double highest)
    : m_outline_seed(noise_key(noise_seed(p.seed), NoisePurpose::Outline, 0)),
      m_bark(noise_seed(p.seed), 1, p.branch.bark_scale),
      m_at_break(furrows_at_break(p)),
      m_away(furrows_away(p)),
      m_outline(outline_of(p)),
      m_taper(static_cast<float>(p.branch.taper)),
      m_curvature(static_cast<float>(p.branch.bend_deg * std::numbers::pi / 180 /
                                     (p.branch.length + p.branch.piece_length))),
      m_lowest(static_cast<float>(lowest)),
      m_highest(static_cast<float>(highest)) {}

/// Along a ray r becomes r (1 - d (r - 1 + width) / width) where the furrow is d deep: from 1 - d (1 + 1 /
/// width) of a distance on.
LimbShape::Furrows LimbShape::furrows_at_break(const FractureParameters& p) {
    double width = std::max(kLeastFurrowWidth, p.tissue.phloem);
    if (has_thorns(p)) {
        // Thorns stand up to the last ring but one; with bundles, and strands anywhere, only in the wood.
        // Jitter and the tissue's border take a part of a cell.
        const double ring = 1 / static_cast<double>(p.branch.rings);
        const bool in_bark =
            p.bundles.radial.empty() && (p.thorns.phloem_probability > 0 || p.ductile.probability > 0);
        width = std::max(0.8 * ring, in_bark ? 0.0 : p.tissue.phloem - 0.7 * ring);
    }
    const double most = kMostFurrowed / (kDeepestFurrow * (1 + 1 / width));
    // Nodes on a ray stray from it to both sides, where furrows are narrow to other depths.
    const double of_narrow = kMostTwist * static_cast<double>(p.branch.sectors) /
                             (kFurrowSlope * p.branch.bark_scale * static_cast<double>(p.branch.rings));
    return {static_cast<float>(std::min({p.branch.bark_relief, most, of_narrow})), static_cast<float>(width)};
}

/// Far from the break there is room for all furrows: they reach as deep as they need.
LimbShape::Furrows LimbShape::furrows_away(const FractureParameters& p) {
    const double deepest = kDeepestFurrow * p.branch.bark_relief;
    const double needed = deepest < kMostFurrowed ? deepest / (kMostFurrowed - deepest) : 1.0;
    return {static_cast<float>(p.branch.bark_relief),
            static_cast<float>(std::clamp(needed, std::max(kLeastFurrowWidth, p.tissue.phloem), 1.0))};
}

/// Fills `scale`, the factor on x and y.
void LimbShape::apply(Block& b) const {
    constexpr std::size_t kSize = Block::kSize;
    std::array<float, kSize> c{}, s{}, depth{}, along{};
    const float low = m_lowest, high = m_highest;
    const Furrows at_break = m_at_break, away = m_away;
    const auto share = [](float radius, float width) {
        return std::clamp((radius - 1 + width) / width, 0.0F, 1.0F);
    };
    for (std::size_t i = 0; i < kSize; ++i) {
        const float radius = std::sqrt(b.x[i] * b.x[i] + b.y[i] * b.y[i]);
        const float inverse = 1 / std::max(radius, 1e-6F);
        c[i] = b.x[i] * inverse;
        s[i] = b.y[i] * inverse;
        along[i] = b.z[i] - std::clamp(b.z[i], low, high);
        const float here = at_break.depth * share(radius, at_break.width);
        const float there = away.depth * share(radius, away.width);
        depth[i] = here + smooth_step(0, kFurrowFade, std::abs(along[i])) * (there - here);
    }
    for (std::size_t i = 0; i < kSize; ++i)
        b.scale[i] =
            (1 - m_taper * along[i]) *
            (1 + m_outline * gradient_noise(m_outline_seed, 0.9F * c[i] + 17.3F, 0.9F * s[i] + 5.7F));
    float deepest = 0;
    for (const float d : depth) deepest = std::max(deepest, d);
    if (deepest <= 0) return;        // wood well inside, as most of a broken surface is
    const BarkRelief bark = m_bark;  // a copy, which the writes below cannot alias
    std::array<float, kSize> factor{};
    for (std::size_t i = 0; i < kSize; ++i) factor[i] = bark.factor(c[i], s[i], along[i]);
    for (std::size_t i = 0; i < kSize; ++i) b.scale[i] *= 1 + (factor[i] - 1) * depth[i];
}

void LimbShape::apply(std::span<Vector3f> points) const {
    scale_plan(points);
    if (m_curvature != 0) bend(points);
}

void LimbShape::scale_plan(std::span<Vector3f> points) const {
    Block block{};
    for (std::size_t begin = 0; begin < points.size(); begin += Block::kSize) {
        const std::size_t count = std::min(Block::kSize, points.size() - begin);
        for (std::size_t i = 0; i < count; ++i) block.set(i, points[begin + i]);
        apply(block);
        for (std::size_t i = 0; i < count; ++i) {
            points[begin + i].x() = block.x[i] * block.scale[i];
            points[begin + i].y() = block.y[i] * block.scale[i];
        }
    }
}

/// The axis becomes an arc that leaves z = 0 upright and bends towards +x.
void LimbShape::bend(std::span<Vector3f> points) const {
    for (Vector3f& p : points) {
        // Nothing is divided by the curvature, which may be as small as can be.
        const float half = 0.5F * m_curvature * p.z();
        const float sine = std::sin(half), chord = std::abs(half) > 1e-4F ? p.z() * sine / half : p.z();
        p = {p.x() * std::cos(2 * half) + chord * sine, p.y(),
             chord * std::cos(half) - p.x() * std::sin(2 * half)};
    }
}

/// The surface that both ends share lies between the lowest and the highest point of the break, where heights
/// do not count: a hole moves as the other end's surface over it, which is worked out once.
void LimbShape::apply(BreakEnds& ends) const {
    std::vector<Vector3f>&stub = ends.stub.positions, &piece = ends.piece.positions;
    const auto shared = static_cast<std::size_t>(ends.surface_vertices);
    scale_plan(stub);
    for (std::size_t i = 0; i < shared; ++i) piece[i].head<2>() = stub[i].head<2>();
    scale_plan(std::span(piece).subspan(shared));
    if (m_curvature == 0) return;
    bend(stub);
    bend(piece);
}

void place_ends(const FractureParameters& parameters, BreakEnds& ends) {
    const LimbShape shape(parameters, ends.lowest, ends.highest);
    if (parameters.output.piece == PiecePlace::Hidden) {
        shape.apply(ends.stub.positions);
        ends.piece.clear();
        return;
    }
    shape.apply(ends);
    if (parameters.output.piece == PiecePlace::Above) {
        const auto gap = static_cast<float>(parameters.fracture.gap);
        for (Vector3f& p : ends.piece.positions) p.z() += gap;
        return;
    }
    float ground = 0, top = 0, right = 0, left = 0;
    for (const Vector3f& p : ends.stub.positions) {
        ground = std::min(ground, p.z());
        right = std::max(right, p.x());
    }
    for (const Vector3f& p : ends.piece.positions) {
        top = std::max(top, p.z());
        left = std::min(left, p.x());
    }
    const float away = std::max(kBeside, right - left + 0.3F);
    for (Vector3f& p : ends.piece.positions) p = {p.x() + away, -p.y(), ground + top - p.z()};
}

void place_log(const FractureParameters& parameters, BranchMesh& log) {
    const LimbShape shape(parameters, 0, 0);
    shape.apply(log.positions);
}

}  // namespace windfall::fracture
