#include "geometry/plane_waves.h"

#include <cmath>
#include <numbers>

#include "core/random.h"

namespace windfall::geometry {

PlaneWaves::PlaneWaves(std::uint64_t seed, int count, double smallest_wave_number,
                       double largest_wave_number) {
    m_waves.reserve(count);
    for (int i = 0; i < count; ++i) {
        const auto u = random_uniform4(seed, RandomPurpose::ImperfectionNoise, i);
        const double z = 2 * u[0] - 1;
        const double angle = 2 * std::numbers::pi * u[1];
        const double rho = std::sqrt(1 - z * z);
        const double number = smallest_wave_number + (largest_wave_number - smallest_wave_number) * u[2];
        m_waves.push_back(
            {number * Vec3(rho * std::cos(angle), rho * std::sin(angle), z), 2 * std::numbers::pi * u[3]});
    }
}

double PlaneWaves::at(const Vec3& point) const {
    double sum = 0;
    for (const Wave& wave : m_waves) sum += std::cos(wave.number.dot(point) + wave.phase);
    return sum;
}

}  // namespace windfall::geometry
