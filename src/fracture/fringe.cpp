#include "fracture/fringe.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/angles.h"
#include "fracture/noise.h"

namespace windfall::fracture {
namespace {

constexpr int kRows = 24, kColumns = 11;
// Thickness of a strip, and how far below the notch it is rooted, in radii.
constexpr float kThickness = 0.04F, kRoot = 0.15F;

float between(float a, float b) { return std::abs(std::remainder(a - b, kTwoPi<float>)); }

/// The lowest point of the stub's broken edge within the strip.
float notch(const BarkStrip& strip, const BreakEnds& ends) {
    float lowest = static_cast<float>(ends.highest);
    for (const RimVertex& rim : ends.rim)
        if (strip.holds(rim.angle))
            lowest = std::min(lowest, ends.stub.positions[static_cast<std::size_t>(rim.vertex)].z());
    return lowest;
}

/// A closed sheet of two sides: rows from the root to the torn end, columns across.
class Strip {
  public:
    Strip(const BarkStrip& strip, float root, float curl, BranchMesh& mesh)
        : m_strip(strip),
          m_root(root),
          m_curl(curl),
          m_mesh(mesh),
          m_first(static_cast<std::int32_t>(mesh.positions.size())) {}

    void add() {
        add_vertices();
        for (int i = 0; i + 1 < kRows; ++i) {
            for (int j = 0; j + 1 < kColumns; ++j) {
                face(at(i, j, 0), at(i, j + 1, 0), at(i + 1, j + 1, 0), at(i + 1, j, 0));
                face(at(i + 1, j, 1), at(i + 1, j + 1, 1), at(i, j + 1, 1), at(i, j, 1));
            }
            face(at(i, 0, 1), at(i, 0, 0), at(i + 1, 0, 0), at(i + 1, 0, 1));
            face(at(i, kColumns - 1, 0), at(i, kColumns - 1, 1), at(i + 1, kColumns - 1, 1),
                 at(i + 1, kColumns - 1, 0));
        }
        for (int j = 0; j + 1 < kColumns; ++j) {
            face(at(0, j, 0), at(0, j, 1), at(0, j + 1, 1), at(0, j + 1, 0));
            face(at(kRows - 1, j, 1), at(kRows - 1, j, 0), at(kRows - 1, j + 1, 0), at(kRows - 1, j + 1, 1));
        }
    }

  private:
    /// Smooth noise of the strip, -1 .. 1.
    float noise(std::uint32_t which, float x, float y) const {
        return gradient_noise(mixed_bits(m_strip.name + which), x, y);
    }

    void add_vertices() {
        const float total = m_strip.length + kRoot, step = total / (kRows - 1);
        const Vector3f out(std::cos(m_strip.angle), std::sin(m_strip.angle), 0);
        const Vector3f side(-out.y(), out.x(), 0);
        float radius = 1 - 0.5F * kThickness, z = m_root;
        for (int i = 0; i < kRows; ++i) {
            const float along = static_cast<float>(i) / (kRows - 1);
            const float lean = 1.4F * m_curl * along * along;
            const Vector3f forth(out * std::sin(lean) + Vector3f::UnitZ() * std::cos(lean));
            const Vector3f normal(out * std::cos(lean) - Vector3f::UnitZ() * std::sin(lean));
            for (int j = 0; j < kColumns; ++j) {
                const float across = static_cast<float>(j) / (kColumns - 1) - 0.5F;
                // Each column ends where its tongue was torn off; the rows beyond it gather there.
                const float tongue =
                    0.7F + 0.3F * std::clamp(0.5F + 1.1F * noise(1, 12.6F * across + 20, 0.5F), 0.0F, 1.0F);
                const float back = std::max(0.0F, along - tongue) * 0.97F * total;
                const float width = 2 * m_strip.half_width * (1 - 0.12F * along * along);
                const float angle =
                    across * width * (1 + 0.15F * noise(2, 6 * along, across > 0 ? 3.0F : 7.0F));
                const float cupped = 1 - 0.6F * along;
                const float flutter = 0.05F * along * noise(3, 5 * across, 4 * along);
                const Vector3f base = out * (radius - (1 - std::cos(angle)) * cupped) +
                                      side * std::sin(angle) + Vector3f(0, 0, z) - forth * back +
                                      normal * flutter;
                const float half = 0.5F * kThickness * (along >= tongue ? 0.35F : 1 - 0.5F * along);
                vertex(base + normal * (half + 0.012F * noise(4, 14 * across, 3 * along * total)),
                       Tissue::Bark, along);
                vertex(base - normal * half, Tissue::Phloem, along);
            }
            radius += std::sin(lean) * step;
            z += std::cos(lean) * step;
        }
    }

    void vertex(const Vector3f& p, Tissue tissue, float along) {
        m_mesh.positions.push_back(p);
        m_mesh.height.push_back(p.z());
        m_mesh.thorn.push_back(along);
        m_mesh.tissue.push_back(tissue);
        m_mesh.bundle.push_back(m_strip.name);
    }
    std::int32_t at(int i, int j, int sheet) const { return m_first + 2 * (i * kColumns + j) + sheet; }
    void face(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
        m_mesh.faces.push_back({a, b, c, d});
        m_mesh.parts.push_back(Part::InnerBark);
        std::array<Vector2f, 4> uv;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::int32_t local = (m_mesh.faces.back()[k] - m_first) / 2;
            const std::int32_t row = local / kColumns, column = local % kColumns;
            uv[k] = {
                (m_strip.angle +
                 (static_cast<float>(column) / (kColumns - 1) - 0.5F) * 2 * m_strip.half_width) /
                    kTwoPi<float>,
                (m_root + static_cast<float>(row) / (kRows - 1) * (m_strip.length + kRoot)) / kTwoPi<float>};
        }
        m_mesh.corner_uvs.push_back(uv);
    }

    BarkStrip m_strip;
    float m_root, m_curl;
    BranchMesh& m_mesh;
    std::int32_t m_first;
};

}  // namespace

bool BarkStrip::holds(float at) const { return between(at, angle) <= half_width; }

std::vector<BarkStrip> bark_strips(const FractureParameters& parameters) {
    const FringeParameters& f = parameters.fringe;
    const std::uint32_t seed = noise_seed(parameters.seed);
    std::vector<BarkStrip> strips;
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(f.strips); ++k) {
        const auto random = [&](std::uint32_t j) { return random_unit(seed, NoisePurpose::Strip, k, j); };
        const BarkStrip strip{kTwoPi<float> * random(0),
                              0.5F * static_cast<float>(f.strip_width) * (0.7F + 0.6F * random(1)),
                              static_cast<float>(f.strip_length) * (0.6F + 0.8F * random(2)),
                              noise_key(seed, NoisePurpose::Strip, k, 4) | 1U};
        const bool apart = std::none_of(strips.begin(), strips.end(), [&](const BarkStrip& other) {
            return between(other.angle, strip.angle) < 1.2F * (other.half_width + strip.half_width);
        });
        if (apart) strips.push_back(strip);
    }
    return strips;
}

float release(const FractureParameters& parameters, const BreakEnds& ends) {
    if (parameters.output.motion == Motion::Breaking) return 0;
    if (parameters.output.piece != PiecePlace::Above) return 1;
    // The tips of the stub lie below `highest` and those of the piece above `lowest`: beyond that sum no bent
    // strand can meet the other end.
    const auto reach = static_cast<float>(ends.highest - ends.lowest);
    return smooth_step(reach, 1.5F * reach, static_cast<float>(parameters.fracture.gap));
}

bool stand_apart(const FractureParameters& parameters, const BreakEnds& ends) {
    return release(parameters, ends) > 0;
}

void add_strips(const FractureParameters& parameters, BreakEnds& ends) {
    for (const BarkStrip& strip : bark_strips(parameters)) {
        const float curl = static_cast<float>(parameters.fringe.strip_curl) *
                           (0.6F + 0.8F * unit_float(mixed_bits(strip.name)));
        Strip(strip, notch(strip, ends) - kRoot, curl, ends.stub).add();
    }
}

}  // namespace windfall::fracture
