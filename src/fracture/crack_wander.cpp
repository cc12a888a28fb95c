#include "fracture/crack_wander.h"

#include <algorithm>
#include <cmath>

#include "fracture/noise.h"

namespace windfall::fracture {
namespace {

struct WanderOctave {
    float frequency;       // waves per radius
    double share;          // of the irregularity
    double largest_slope;  // amplitude times frequency is no more than this
    float lean_x, lean_y;  // radii sideways per radius down
};

// Gradient noise is no steeper than 1.7 amplitudes a wave: with slopes of 0.57 in all the section cannot
// fold.
constexpr std::array<WanderOctave, 5> kWander{{{1.3F, 0.6, 0.15, 0.03F, -0.05F},
                                               {2.6F, 0.75, 0.15, 0.05F, 0.04F},
                                               {9, 0.37, 0.12, -0.09F, 0.07F},
                                               {33, 0.115, 0.10, 0.05F, 0.06F},
                                               {90, 0.03, 0.05, -0.03F, 0.02F}}};
constexpr double kMostChord = 0.15;  // of a ring, or of an arc
constexpr float kStill = 0.15F;      // radius about the pith in which the displacement grows from nothing

}  // namespace

CrackWander::CrackWander(const FractureParameters& parameters, double ring_width, double arc) {
    const std::uint32_t seed = noise_seed(parameters.seed);
    for (std::uint32_t k = 0; k < kWander.size(); ++k) {
        const WanderOctave& o = kWander[k];
        // The chord of an arc leaves the wave by up to amplitude (frequency arc)^2: keep it well inside a
        // ring, and what the chord along a ray leaves well inside an arc.
        const double across = std::min(1.0, o.frequency * arc),
                     along = std::min(1.0, o.frequency * ring_width);
        const double amplitude =
            std::min({parameters.cracks.irregularity * o.share, o.largest_slope / o.frequency,
                      kMostChord * ring_width / (across * across), kMostChord * arc / (along * along)});
        m_octaves[k] = {static_cast<float>(amplitude),
                        o.frequency,
                        o.lean_x,
                        o.lean_y,
                        noise_key(seed, NoisePurpose::Crack, k, 200),
                        noise_key(seed, NoisePurpose::Crack, k, 201)};
    }
}

Eigen::Vector2d CrackWander::moved(const Eigen::Vector2d& point, double z) const {
    std::array<float, 2> place{static_cast<float>(point.x()), static_cast<float>(point.y())}, shift{0, 0};
    displace(place.data(), place.data() + 1, 1, static_cast<float>(z), shift.data(), shift.data() + 1);
    return point + Eigen::Vector2d(shift[0], shift[1]);
}

void CrackWander::move(std::vector<Eigen::Vector2d>& points, double z) const {
    const std::size_t count = points.size();
    std::vector<float> arrays(4 * count, 0.0F);
    float *x = arrays.data(), *y = x + count, *shift_x = y + count, *shift_y = shift_x + count;
    for (std::size_t i = 0; i < count; ++i) {
        x[i] = static_cast<float>(points[i].x());
        y[i] = static_cast<float>(points[i].y());
    }
    displace(x, y, count, static_cast<float>(z), shift_x, shift_y);
    for (std::size_t i = 0; i < count; ++i) points[i] += Eigen::Vector2d(shift_x[i], shift_y[i]);
}

void CrackWander::displace(const float* x, const float* y, std::size_t count, float z,
                           float* __restrict shift_x, float* __restrict shift_y) const {
    for (const Octave& o : m_octaves) {
        const float lean_x = o.lean_x * z, lean_y = o.lean_y * z;
        for (std::size_t i = 0; i < count; ++i)
            shift_x[i] += o.amplitude * gradient_noise(o.seed_x, o.frequency * (x[i] + lean_x),
                                                       o.frequency * (y[i] + lean_y));
        for (std::size_t i = 0; i < count; ++i)
            shift_y[i] += o.amplitude * gradient_noise(o.seed_y, o.frequency * (x[i] + lean_x),
                                                       o.frequency * (y[i] + lean_y));
    }
    for (std::size_t i = 0; i < count; ++i) {
        const float share = m_scale * smooth_step(0, kStill, std::sqrt(x[i] * x[i] + y[i] * y[i]));
        shift_x[i] *= share;
        shift_y[i] *= share;
    }
}

}  // namespace windfall::fracture
