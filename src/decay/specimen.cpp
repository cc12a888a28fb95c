#include "decay/specimen.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "geometry/layered_mesh.h"

namespace windfall::decay {

Specimen specimen_of(const FruitParameters& fruit) {
    return {fruit_surface(fruit.kind, fruit.mass_kg), {}, {}, nullptr};
}

Specimen specimen_of(const std::shared_ptr<const ArtistFruit>& artist) {
    return {
        [artist](const geometry::Vec3& d) { return artist->map.point(d); },
        [artist](const geometry::Vec3& d, double fraction) { return artist->interior.point(d, fraction); },
        {},
        artist};
}

std::string off_the_fruit_text(const geometry::Vec3& wound, const geometry::Vec3& nearest) {
    return fmt::format(
        "the wound at {:g}, {:g}, {:g} m is {:.3g} m away from the fruit; the nearest place on its skin is "
        "{:.3g}, "
        "{:.3g}, {:.3g} (metres, y up, the fruit stands on y = 0)",
        wound.x(), wound.y(), wound.z(), (wound - nearest).norm(), nearest.x(), nearest.y(), nearest.z());
}

void check_wounds(const DecayParameters& parameters, const SurfaceFunction& surface) {
    constexpr int kCells = 48;
    const std::vector<double>& wounds = parameters.start.wounds_m;
    if (wounds.empty() || parameters.pile.count > 1 || parameters.pile.ground != PileGround::Table) return;
    const geometry::BrickSurface brick = geometry::make_brick_surface({kCells, kCells, kCells});
    std::vector<geometry::Vec3> points = geometry::brick_directions(brick, geometry::Vec3::Ones());
    double lowest = 0;
    for (geometry::Vec3& p : points) {
        p = surface(p);
        lowest = std::min(lowest, p.z());
    }
    for (std::size_t k = 0; k + 2 < wounds.size(); k += 3) {
        const geometry::Vec3 wound(wounds[k], wounds[k + 1], wounds[k + 2]);
        const geometry::Vec3 place = fruit_axes(wound) + geometry::Vec3(0, 0, lowest);
        const geometry::Vec3& nearest =
            *std::min_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
                return (a - place).squaredNorm() < (b - place).squaredNorm();
            });
        if ((nearest - place).norm() > kOnTheFruit_m)
            throw InputError(
                "start.wounds_m: " +
                off_the_fruit_text(
                    wound, take_axes((nearest - geometry::Vec3(0, 0, lowest)).cast<float>()).cast<double>()));
    }
}

}  // namespace windfall::decay
