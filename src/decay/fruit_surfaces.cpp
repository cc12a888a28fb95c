#include "decay/fruit_surfaces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "geometry/layered_mesh.h"

namespace windfall::decay {
namespace {

using geometry::Vec3;

/// exp(-(angle / width)^2): a dimple's depth over its largest.
double dimple(double angle, double width) { return std::exp(-(angle / width) * (angle / width)); }

/// Angles of a direction: from the stem (+z) down, and around.
struct Polar {
    double down, around, sine, cosine;
    explicit Polar(const Vec3& direction) {
        cosine = std::clamp(direction.z(), -1.0, 1.0);
        down = std::acos(cosine);
        around = std::atan2(direction.y(), direction.x());
        sine = std::sin(down);
    }
    double up() const { return std::numbers::pi - down; }
};

Vec3 tomato(const Vec3& d) {
    const Polar p(d);
    const double ribs = 1 + 0.025 * p.sine * p.sine * std::cos(5 * p.around);
    const double radius = ribs * (1 - 0.22 * dimple(p.down, 0.38)) * (1 - 0.05 * dimple(p.up(), 0.4));
    return radius * Vec3(d.x(), d.y(), 0.82 * d.z());
}

Vec3 apple(const Vec3& d) {
    const Polar p(d);
    // Five humps about the calyx, hardly any at the stem.
    const double humps = 1 + 0.012 * p.sine * std::cos(5 * p.around) * (0.65 - 0.35 * p.cosine);
    const double radius = humps * (1 - 0.42 * dimple(p.down, 0.42)) * (1 - 0.17 * dimple(p.up(), 0.35));
    const double taper = 1 - 0.10 * std::max(0.0, -d.z());
    return radius * Vec3(taper * d.x(), taper * d.y(), 0.95 * d.z());
}

Vec3 orange(const Vec3& d) {
    const Polar p(d);
    const double radius = (1 - 0.035 * dimple(p.down, 0.22)) * (1 - 0.02 * dimple(p.up(), 0.25));
    return radius * Vec3(d.x(), d.y(), 0.97 * d.z());
}

Vec3 peach(const Vec3& d) {
    const Polar p(d);
    // The suture: a furrow down one side, deep at the stem.
    const double suture = 0.05 * dimple(p.around, 0.28) * p.sine * (0.6 + 0.4 * p.cosine);
    const double tip = 0.03 * dimple(p.up(), 0.25);
    const double radius = (1 - suture) * (1 - 0.25 * dimple(p.down, 0.33)) * (1 + tip);
    return radius * Vec3(d.x(), d.y(), 0.95 * d.z());
}

Vec3 pear(const Vec3& d) {
    const Polar p(d);
    // A belly and a blunt neck: how wide it is goes with how high.
    const double height = p.cosine > 0 ? 1.5 * p.cosine : 0.95 * p.cosine;
    const double neck = std::clamp(height / 1.2, 0.0, 1.0);
    const double width = 1 - 0.5 * neck * neck * (3 - 2 * neck);
    const double calyx = 1 - 0.10 * dimple(p.up(), 0.25), stem = 1 - 0.04 * dimple(p.down, 0.25);
    return {width * d.x(), width * d.y(), calyx * stem * height};
}

SurfaceFunction unit_surface(FruitKind kind) {
    switch (kind) {
        case FruitKind::Tomato:
            return tomato;
        case FruitKind::Apple:
            return apple;
        case FruitKind::Orange:
            return orange;
        case FruitKind::Peach:
            return peach;
        case FruitKind::Pear:
            return pear;
        case FruitKind::Ball:
            return [](const Vec3& d) { return d; };
        case FruitKind::Mesh:
            break;
    }
    throw std::logic_error("a mesh has no shape of its own kind");
}

}  // namespace

double surface_volume(const SurfaceFunction& surface, int cells) {
    const geometry::BrickSurface brick = geometry::make_brick_surface({cells, cells, cells});
    std::vector<Vec3> points = geometry::brick_directions(brick, Vec3::Ones());
    for (Vec3& p : points) p = surface(p);
    return geometry::enclosed_volume(points, {brick.quads.begin(), brick.quads.end()});
}

SurfaceFunction scaled(const SurfaceFunction& surface, double factor) {
    return [surface, factor](const Vec3& d) { return Vec3(factor * surface(d)); };
}

SurfaceFunction fruit_surface(FruitKind kind, double mass_kg) {
    const SurfaceFunction unit = unit_surface(kind);
    return scaled(unit, std::cbrt(mass_kg / kFruitDensity_kg_m3 / surface_volume(unit)));
}

}  // namespace windfall::decay
