#include "fracture/placing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fracture/noise.h"

namespace windfall::fracture {
namespace {

// Between the axes of the stub and of the piece beside it, in radii, for straight branches.
constexpr float kBeside = 2.7F;

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
      m_bark(noise_seed(p.seed), p.branch.bark_relief, p.branch.bark_scale),
      m_phloem(std::max(0.02F, static_cast<float>(p.tissue.phloem))),
      m_outline(static_cast<float>(p.branch.outline)),
      m_taper(static_cast<float>(p.branch.taper)),
      m_curvature(static_cast<float>(p.branch.bend_deg * std::numbers::pi / 180 /
                                     (p.branch.length + p.branch.piece_length))),
      m_lowest(static_cast<float>(lowest)),
      m_highest(static_cast<float>(highest)) {}

/// Fills `scale`, the factor on x and y.
void LimbShape::apply(Block& b) const {
    constexpr std::size_t kSize = Block::kSize;
    std::array<float, kSize> c{}, s{}, depth{};
    float deepest = 0;
    for (std::size_t i = 0; i < kSize; ++i) {
        const float radius = std::sqrt(b.x[i] * b.x[i] + b.y[i] * b.y[i]);
        const float inverse = 1 / std::max(radius, 1e-6F);
        c[i] = b.x[i] * inverse;
        s[i] = b.y[i] * inverse;
        depth[i] = std::clamp((radius - 1 + m_phloem) / m_phloem, 0.0F, 1.0F);
    }
    for (const float d : depth) deepest = std::max(deepest, d);
    for (std::size_t i = 0; i < kSize; ++i)
        b.scale[i] =
            (1 - m_taper * b.z[i]) *
            (1 + m_outline * gradient_noise(m_outline_seed, 0.9F * c[i] + 17.3F, 0.9F * s[i] + 5.7F));
    if (deepest <= 0 || m_bark.depth <= 0) return;
    const BarkRelief bark = m_bark;  // a copy, which the writes below cannot alias
    const float low = m_lowest, high = m_highest;
    std::array<float, kSize> factor{};
    for (std::size_t i = 0; i < kSize; ++i) {
        const float below = b.z[i] < low ? b.z[i] - low : 0.0F;
        const float above = b.z[i] > high ? b.z[i] - high : 0.0F;
        factor[i] = bark.factor(c[i], s[i], below + above);
    }
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
        const float turn = m_curvature * p.z();
        const float reach = 1 / m_curvature - p.x();
        p = {1 / m_curvature - reach * std::cos(turn), p.y(), reach * std::sin(turn)};
    }
}

/// Where the piece has the stub's vertices it takes their new places; only the others are worked out.
void LimbShape::apply(BreakEnds& ends) const {
    std::vector<Vector3f>&stub = ends.stub.positions, &piece = ends.piece.positions;
    const auto shared = static_cast<std::size_t>(ends.surface_vertices);
    Block block{}, holes{};
    std::array<std::size_t, Block::kSize> hole_vertices{};
    std::array<bool, Block::kSize> same{};
    std::size_t hole_count = 0;
    const auto finish_holes = [&] {
        apply(holes);
        for (std::size_t k = 0; k < hole_count; ++k) {
            piece[hole_vertices[k]].x() = holes.x[k] * holes.scale[k];
            piece[hole_vertices[k]].y() = holes.y[k] * holes.scale[k];
        }
        hole_count = 0;
    };
    for (std::size_t begin = 0; begin < shared; begin += Block::kSize) {
        const std::size_t count = std::min(Block::kSize, shared - begin);
        for (std::size_t i = 0; i < count; ++i) {
            block.set(i, stub[begin + i]);
            same[i] = stub[begin + i] == piece[begin + i];
            if (same[i]) continue;
            holes.set(hole_count, piece[begin + i]);
            hole_vertices[hole_count++] = begin + i;
            if (hole_count == Block::kSize) finish_holes();
        }
        apply(block);
        for (std::size_t i = 0; i < count; ++i) {
            stub[begin + i].x() = block.x[i] * block.scale[i];
            stub[begin + i].y() = block.y[i] * block.scale[i];
            if (same[i]) piece[begin + i] = stub[begin + i];
        }
    }
    finish_holes();
    scale_plan(std::span(stub).subspan(shared));
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
