#include "decay/body_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.h"
#include "decay/body_measure.h"
#include "geometry/layered_mesh.h"
#include "geometry/plane_waves.h"

namespace windfall::decay {

namespace {

using geometry::Vec3;

constexpr int kLeastSteps = 2;
/// Hard loads (a very soft fruit that dries fast) need more, or the flesh lags behind and crumples.
constexpr int kMostSteps = 12;
constexpr float kStill_m = 60e-6F;
/// Root mean square of how much longer than the settled flesh the skin is laid, here more and there less: an
/// even skin would buckle in the pattern of the mesh.
constexpr double kUnevenness = 0.012;
constexpr int kUnevenWaves = 48;

std::vector<Vec3> surface_points(const SurfaceFunction& surface, const std::vector<Vec3>& directions) {
    std::vector<Vec3> points;
    points.reserve(directions.size());
    for (const Vec3& d : directions) {
        points.push_back(surface(d));
        if (!points.back().allFinite())
            throw InputError("body: the surface is not finite everywhere; check the fruit's shape");
    }
    return points;
}

/// Centroid of the volume inside a closed surface.
Vec3 centroid_of(const std::vector<Vec3>& points, const std::vector<geometry::Face>& faces) {
    Vec3 sum = Vec3::Zero();
    double six_volumes = 0;
    for (const auto& f : faces)
        for (int k = 1; k < 3; ++k) {
            const Vec3& a = points[f[0]];
            const Vec3& b = points[f[k]];
            const Vec3& c = points[f[k + 1]];
            const double six = a.dot(b.cross(c));
            six_volumes += six;
            sum += six * (a + b + c) / 4;
        }
    return sum / six_volumes;
}

std::vector<float> uneven_stretch(const std::vector<Vec3>& points, double wave_length_m, std::uint64_t seed) {
    const double number = 2 * std::numbers::pi / wave_length_m;
    const geometry::PlaneWaves noise(seed, kUnevenWaves, 0.5 * number, 1.2 * number);
    const double scale = kUnevenness / std::sqrt(kUnevenWaves / 2.0);
    std::vector<float> result;
    result.reserve(points.size());
    for (const Vec3& x : points) result.push_back(static_cast<float>(scale * noise.at(x)));
    return result;
}

}  // namespace

Body::Parts::Parts(const SurfaceFunction& surface, const BodySettings& body_settings,
                   const InteriorFunction& interior)
    : settings((check_settings(body_settings), body_settings)),
      skin_brick(
          geometry::make_brick_surface({settings.skin_cells, settings.skin_cells, settings.skin_cells})),
      directions(geometry::brick_directions(skin_brick, Vec3::Ones())),
      fresh(surface_points(surface, directions)),
      faces(skin_brick.quads.begin(), skin_brick.quads.end()),
      mesh(make_flesh_mesh(surface, interior ? interior : towards_centre(surface, centroid_of(fresh, faces)),
                           settings.flesh_cells, settings.flesh_layers)),
      fresh_volume_m3(geometry::enclosed_volume(fresh, faces)),
      density_kg_m3(settings.mass_kg / fresh_volume_m3),
      material(mesh, settings, density_kg_m3),
      solver(mesh, density_kg_m3),
      embedding(mesh.brick, {mesh.nodes.begin(), mesh.nodes.begin() + mesh.columns()}, skin_brick, fresh),
      skin(skin_brick, fresh) {
    skin_material = decay::skin_material(settings.skin_modulus_pa, skin_thickness_of(settings.thickness),
                                         fresh_modulus_pa(settings.firmness), skin.mesh().mean_edge_m,
                                         settings.wave_length_m);
    skin.set_material(skin_material);
    target = skin.positions();
    rest = target;
    find_flesh();
}

void Body::Parts::translate(const Eigen::Vector3f& by_m) {
    solver.translate(by_m);
    for (auto& x : fresh) x += by_m.cast<double>();
    for (auto* points : {&target, &rest, &flesh})
        for (auto& x : *points) x += by_m;
    skin.lay(target, std::vector<float>(target.size(), 0.0F));
}

std::vector<ContactPlane> Body::Parts::ground_planes(const std::vector<Eigen::Vector3f>& points) const {
    std::vector<ContactPlane> planes(points.size());
    std::transform(points.begin(), points.end(), planes.begin(), ground);
    return planes;
}

std::vector<Eigen::Vector3f> Body::Parts::flesh_surface_points() const {
    std::vector<Eigen::Vector3f> points(mesh.columns());
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = solver.positions()[i].head<3>();
    return points;
}

void Body::Parts::flesh_frame(double gravity_m_s2, int least_steps, int most_steps) {
    auto& energy = solver.energy();
    energy.set_gravity(gravity_m_s2);
    energy.set_material(material.modulus_pa(), material.theta());
    energy.set_planes(ground_planes(flesh_surface_points()), neighbours.flesh);
    solver.begin_frame();
    solver.descend(least_steps, most_steps, kStill_m);
    energy.surface_gradients(solver.positions(), m_gradients);
    embedding.map(solver.positions(), m_gradients, target);
}

void Body::Parts::settle_step(double gravity_m_s2) {
    material.apply({}, std::vector<float>(mesh.columns(), 0.0F), 1);
    flesh_frame(gravity_m_s2, 1, 1);
    skin.lay(target, std::vector<float>(target.size(), 0.0F));
}

void Body::Parts::finish_settling() {
    skin.lay(target, uneven_stretch(fresh, skin_material.wave_length_m, settings.seed));
    skin.advance(target, ground_planes(target), neighbours.skin);
    rest = skin.positions();
    find_flesh();
}

void Body::Parts::find_flesh() {
    const auto& x = skin.positions();
    const auto thickness = static_cast<float>(skin_material.thickness_m);
    flesh = surface_normals(x, faces);
    for (std::size_t i = 0; i < x.size(); ++i) flesh[i] = x[i] - thickness * flesh[i];
}

void Body::Parts::advance(const BodyLoad& load) {
    check_load(load, fresh.size());
    // Water weighs 1000 kg/m3, which a light fruit may not have: its solids keep a tenth of the mass.
    const double water_lost_kg = 1000 * load.water_fraction_lost * fresh_volume_m3;
    const double mass_ratio = std::max(0.1, 1 - water_lost_kg / settings.mass_kg);
    solver.energy().set_mass_ratio(mass_ratio);
    material.apply(load,
                   load.rot.empty() ? std::vector<float>(mesh.columns(), 0.0F) : embedding.coarsen(load.rot),
                   mass_ratio);
    flesh_frame(load.gravity_m_s2, kLeastSteps, kMostSteps);
    skin.advance(target, ground_planes(target), neighbours.skin);
    find_flesh();
    const auto& x = skin.positions();
    if (!std::all_of(x.begin(), x.end(), [](const auto& p) { return p.allFinite(); }))
        throw RunError("the fruit's body has lost its shape (positions are not finite)");
}

}  // namespace windfall::decay
