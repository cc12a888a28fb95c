#pragma once
// Band-limited noise in space: a sum of random plane waves, the same whatever mesh it is sampled on.
#include <cstdint>
#include <vector>

#include "geometry/surface_mesh.h"

namespace windfall::geometry {

/// Sum of `count` plane waves with random directions, phases and wave numbers even in [smallest, largest].
class PlaneWaves {
  public:
    PlaneWaves(std::uint64_t seed, int count, double smallest_wave_number, double largest_wave_number);
    double at(const Vec3& point) const;

  private:
    struct Wave {
        Vec3 number;
        double phase;
    };
    std::vector<Wave> m_waves;
};

}  // namespace windfall::geometry
