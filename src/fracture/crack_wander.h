#pragma once
// Random radial and tangential displacement of rays and rings, so that cracks are not straight (Yang, Yang,
// Yang 2019, section 4.1, fig. 12b).
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "fracture/parameters.h"

namespace windfall::fracture {

/// A smooth displacement of the cross-section: octaves of noise from the radius down to a hundredth of it.
/// Nothing moves at the pith. Down the branch it hardly changes, since cracks follow the fibres: each octave
/// leans in its own way, which makes the walls rough. However large the irregularity, the octaves are held
/// back so far that no two points of the section change places, nor two nodes of the lattice.
class CrackWander {
  public:
    /// `ring_width`, `arc`: of the lattice's cells at the bark, radii.
    CrackWander(const FractureParameters& parameters, double ring_width, double arc);

    /// Where a point of the cross-section at height z goes, radii.
    Eigen::Vector2d moved(const Eigen::Vector2d& point, double z) const;

    /// The same for many points at once, which is faster.
    void move(std::vector<Eigen::Vector2d>& points, double z) const;

    /// Halves the displacement.
    void calm() { m_scale *= 0.5F; }
    /// Nothing moves any more; false when nothing did before.
    bool stop() { return std::exchange(m_scale, 0.0F) > 0; }

  private:
    struct Octave {
        float amplitude, frequency, lean_x, lean_y;
        std::uint32_t seed_x, seed_y;
    };
    /// Adds the displacements of `count` points to `shift_x` and `shift_y`, which must be 0.
    void displace(const float* x, const float* y, std::size_t count, float z, float* shift_x,
                  float* shift_y) const;

    std::array<Octave, 5> m_octaves{};
    float m_scale = 1;
};

}  // namespace windfall::fracture
