#include "decay/rotting_pile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "core/random.h"
#include "decay/body_archive.h"
#include "decay/bowl_mesh.h"
#include "decay/starting_points.h"

namespace windfall::decay {
namespace {

constexpr double kTouching_m = 1.5e-3;
// Contacts are patches of many vertices: rot begins in a few places of each.
constexpr std::size_t kStartsOfContact = 3;

BodySettings body_settings(const DecayParameters& p, double relative_size) {
    BodySettings settings;
    settings.mass_kg = p.fruit.mass_kg * relative_size * relative_size * relative_size;
    settings.firmness = p.fruit.firmness;
    settings.thickness = p.fruit.thickness;
    settings.softening = p.body.softening;
    settings.skin_modulus_pa = p.body.skin_modulus_pa;
    settings.rot_shrinkage = p.body.rot_shrinkage;
    settings.rot_softening = p.body.rot_softening;
    settings.rot_depth_m = p.body.rot_depth_m;
    settings.wave_length_m = p.body.wrinkle_m;
    settings.skin_cells = static_cast<int>(p.body.skin_cells);
    settings.flesh_cells = static_cast<int>(p.body.flesh_cells);
    settings.seed = p.seed;
    return settings;
}

PileSettings pile_settings(const DecayParameters& p) {
    PileSettings settings;
    if (p.pile.ground == PileGround::Bowl) {
        settings.bowl_radius_m = p.pile.bowl_radius_m;
        settings.bowl_height_m = p.pile.bowl_height_m;
    }
    settings.seed = p.seed;
    return settings;
}

/// A place drawn from the seed: anywhere but on the underside.
geometry::Vec3 random_direction(std::uint64_t seed, std::size_t fruit, std::int64_t number) {
    const auto u = random_uniform4(seed, RandomPurpose::RotWounds, static_cast<std::uint64_t>(number),
                                   static_cast<std::uint32_t>(fruit));
    const double z = -0.45 + 1.35 * u[0], around = 2 * std::numbers::pi * u[1], r = std::sqrt(1 - z * z);
    return {r * std::cos(around), r * std::sin(around), z};
}

std::vector<Eigen::Vector3f> in_take_axes(const std::vector<Eigen::Vector3f>& points) {
    std::vector<Eigen::Vector3f> turned(points.size());
    std::transform(points.begin(), points.end(), turned.begin(), take_axes);
    return turned;
}

std::vector<geometry::Vec3> to_double(const std::vector<Eigen::Vector3f>& points) {
    std::vector<geometry::Vec3> result(points.size());
    std::transform(points.begin(), points.end(), result.begin(),
                   [](const Eigen::Vector3f& p) { return geometry::Vec3(p.cast<double>()); });
    return result;
}

}  // namespace

RottingPile::RottingPile(const DecayParameters& parameters, const Specimen& specimen,
                         const RunContext& context)
    : m_parameters(parameters),
      m_climate(water::climate_of(parameters.climate)),
      m_atlas(static_cast<int>(parameters.output.texels)) {
    settle(specimen, context);
    start(specimen);
}

void RottingPile::settle(const Specimen& specimen, const RunContext& context) {
    const auto count = static_cast<std::size_t>(m_parameters.pile.count);
    m_relative_size.assign(count, 1);
    m_poses.assign(count, {});
    std::vector<PileFruit> fruit(count);
    for (std::size_t f = 0; f < count; ++f) {
        if (count > 1) {
            const double u = random_uniform4(m_parameters.seed, RandomPurpose::PileSizes, f)[0];
            m_relative_size[f] = 1 + m_parameters.pile.variation * (2 * u - 1);
        }
        fruit[f] = {scaled(specimen.surface, m_relative_size[f]),
                    m_parameters.fruit.mass_kg * std::pow(m_relative_size[f], 3)};
    }
    const bool drop = count > 1 || m_parameters.pile.ground == PileGround::Bowl;
    const PileSettings pile = pile_settings(m_parameters);
    if (drop) m_poses = settle_pile(fruit, pile, context).poses;
    std::vector<Body> bodies;
    for (std::size_t f = 0; f < count; ++f) {
        InteriorFunction interior;
        if (specimen.interior)
            interior = [inner = specimen.interior, size = m_relative_size[f]](const geometry::Vec3& d,
                                                                              double fraction) {
                return geometry::Vec3(size * inner(d, fraction));
            };
        bodies.emplace_back(posed(fruit[f].surface, m_poses[f]),
                            body_settings(m_parameters, m_relative_size[f]),
                            interior ? posed(interior, m_poses[f]) : interior);
        if (!drop) bodies.back().settle(context);
    }
    m_bodies = std::make_unique<BodyPile>(std::move(bodies), ground_of(pile));
    if (drop) m_bodies->settle(context);
    for (const Body& body : m_bodies->bodies()) m_fresh_volume.push_back(body.volume_m3());
}

std::vector<SkinStarts> RottingPile::starting_places(const Specimen& specimen) const {
    const StartParameters& wanted = m_parameters.start;
    const std::vector<Body>& bodies = m_bodies->bodies();
    std::vector<SkinStarts> starts(bodies.size());
    for (const ContactPatch& patch : m_bodies->patches(kTouching_m)) {
        if (patch.vertices.empty()) continue;
        auto& contacts = starts[static_cast<std::size_t>(patch.body)].contacts;
        const auto& directions = bodies[static_cast<std::size_t>(patch.body)].directions();
        const std::size_t step = std::max<std::size_t>(1, patch.vertices.size() / kStartsOfContact);
        for (std::size_t i = step / 2; i < patch.vertices.size(); i += step)
            contacts.push_back(directions[static_cast<std::size_t>(patch.vertices[i])]);
    }
    for (std::size_t f = 0; f < bodies.size(); ++f) {
        for (std::int64_t k = 0; k < wanted.random; ++k)
            starts[f].wounds.push_back(random_direction(m_parameters.seed, f, k));
        if (wanted.stem) starts[f].wounds.emplace_back(geometry::Vec3::UnitZ());
    }
    for (std::size_t k = 0; k + 2 < wanted.wounds_m.size(); k += 3) {
        const geometry::Vec3 asked(wanted.wounds_m[k], wanted.wounds_m[k + 1], wanted.wounds_m[k + 2]);
        const Eigen::Vector3f point = fruit_axes(asked).cast<float>();
        float nearest = std::numeric_limits<float>::infinity();
        std::size_t fruit = 0, vertex = 0;
        for (std::size_t f = 0; f < bodies.size(); ++f)
            for (std::size_t v = 0; v < bodies[f].rest().size(); ++v) {
                const float distance = (bodies[f].rest()[v] - point).norm();
                if (distance < nearest) nearest = distance, fruit = f, vertex = v;
            }
        if (nearest > kOnTheFruit_m) {
            throw InputError(
                "start.wounds_m: " +
                off_the_fruit_text(asked, take_axes(bodies[fruit].rest()[vertex]).cast<double>()));
        }
        starts[fruit].wounds.push_back(bodies[fruit].directions()[vertex]);
    }
    for (std::size_t f = 0; f < bodies.size() && !specimen.mask.empty(); ++f)
        for (const std::size_t texel :
             painted_texels(m_atlas, specimen.mask, static_cast<std::size_t>(wanted.mask_wounds),
                            m_parameters.seed, static_cast<std::uint32_t>(f)))
            starts[f].wounds.push_back(m_atlas.texel_direction(texel));
    return starts;
}

void RottingPile::start(const Specimen& specimen) {
    const std::vector<SkinStarts> starts = starting_places(specimen);
    for (std::size_t f = 0; f < starts.size(); ++f) {
        const SurfaceFunction surface = scaled(specimen.surface, m_relative_size[f]);
        m_skins.emplace_back(m_parameters, m_atlas, surface, starts[f], std::pow(m_relative_size[f], 3),
                             m_parameters.seed + f);
        m_forms.emplace_back(m_atlas, specimen, m_relative_size[f], m_bodies->bodies()[f]);
    }
}

std::string RottingPile::name_of(const char* mesh, std::size_t fruit) const {
    return m_skins.size() == 1 ? mesh : fmt::format("{}_{}", mesh, fruit);
}

void RottingPile::add_meshes(take::FrameSink& sink) const {
    for (std::size_t f = 0; f < m_skins.size(); ++f) {
        const Body& body = m_bodies->bodies()[f];
        for (const char* name : {"skin", "flesh"}) {
            const bool skin = name == std::string("skin");
            if (!skin && !m_parameters.output.flesh) continue;
            take::TakeMesh mesh;
            mesh.name = name_of(name, f);
            mesh.rest.positions =
                to_double(in_take_axes(m_forms[f].positions(skin ? body.rest() : body.flesh())));
            mesh.rest.faces = m_forms[f].faces();
            mesh.rest.corner_uvs = m_forms[f].corner_uvs();
            sink.add_mesh(mesh);
        }
    }
    if (m_parameters.pile.ground == PileGround::Bowl) {
        take::TakeMesh mesh;
        mesh.name = "bowl";
        mesh.rest = bowl_mesh(m_parameters.pile.bowl_radius_m, m_parameters.pile.bowl_height_m);
        for (geometry::Vec3& p : mesh.rest.positions) p = take_axes(p.cast<float>()).cast<double>();
        sink.add_mesh(mesh);
    }
}

take::Frame RottingPile::frame() const {
    take::Frame frame;
    frame.index = m_frame;
    frame.time = time_h();
    const water::Air air = m_climate.at(time_h());
    frame.scalars = {
        {"hours", time_h()}, {"temperature_c", air.temperature_c}, {"humidity", air.relative_humidity}};
    auto& scalars = frame.scalars;
    for (std::size_t f = 0; f < m_skins.size(); ++f) {
        const Body& body = m_bodies->bodies()[f];
        frame.meshes.push_back({name_of("skin", f), in_take_axes(m_forms[f].positions(body.skin())), {}});
        if (m_parameters.output.flesh)
            frame.meshes.push_back(
                {name_of("flesh", f), in_take_axes(m_forms[f].positions(body.flesh())), {}});
        for (take::FrameMap& map : m_skins[f].maps(name_of("skin", f), m_forms[f]))
            frame.maps.push_back(std::move(map));
        // Errors keep their largest magnitude; all else adds up over the fruit of a pile.
        for (const auto& [key, value] : m_skins[f].numbers()) {
            if (key.ends_with("_error"))
                scalars[key] = std::max(scalars[key], std::abs(value));
            else
                scalars[key] += value;
        }
        scalars["volume_m3"] += body.volume_m3();
        scalars["fresh_volume_m3"] += m_fresh_volume[f];
        scalars["area_m2"] += body.area_m2();
        scalars["height_m"] = std::max(scalars["height_m"], body.height_m());
    }
    if (m_parameters.pile.ground == PileGround::Bowl) {
        const geometry::SurfaceMesh bowl =
            bowl_mesh(m_parameters.pile.bowl_radius_m, m_parameters.pile.bowl_height_m);
        std::vector<Eigen::Vector3f> points;
        for (const geometry::Vec3& p : bowl.positions) points.push_back(take_axes(p.cast<float>()));
        frame.meshes.push_back({"bowl", std::move(points), {}});
    }
    return frame;
}

void RottingPile::infect_neighbours() {
    const std::vector<Body>& bodies = m_bodies->bodies();
    std::vector<std::pair<std::size_t, geometry::Vec3>> caught;
    for (const ContactPatch& patch : m_bodies->patches(kTouching_m)) {
        if (patch.other < 0) continue;
        const auto from = static_cast<std::size_t>(patch.body), to = static_cast<std::size_t>(patch.other);
        for (const std::int32_t vertex : patch.vertices) {
            const auto v = static_cast<std::size_t>(vertex);
            if (!m_skins[from].is_rotten(bodies[from].directions()[v])) continue;
            // The neighbour's skin vertex nearest to this one.
            const Eigen::Vector3f& place = bodies[from].skin()[v];
            const auto& skin = bodies[to].skin();
            const auto nearest =
                std::min_element(skin.begin(), skin.end(), [&](const auto& a, const auto& b) {
                    return (a - place).squaredNorm() < (b - place).squaredNorm();
                });
            caught.emplace_back(to,
                                bodies[to].directions()[static_cast<std::size_t>(nearest - skin.begin())]);
            break;  // one place a patch and frame is enough
        }
    }
    for (const auto& [fruit, direction] : caught) m_skins[fruit].infect(direction);
}

void RottingPile::advance() {
    const double hours = m_parameters.output.hours_per_frame;
    const water::Air air = m_climate.at(time_h() + 0.5 * hours);
    std::vector<std::vector<float>> rot(m_skins.size());
    std::vector<BodyLoad> loads(m_skins.size());
    for (std::size_t f = 0; f < m_skins.size(); ++f) {
        const Body& body = m_bodies->bodies()[f];
        m_skins[f].grow(hours, air);
        m_skins[f].lose_water(hours, body.area_m2(), air);
        rot[f] = m_skins[f].rot_at(body.directions());
        loads[f].water_fraction_lost =
            std::min(0.95, m_parameters.body.shrinking * m_skins[f].ledger().lost_kg() /
                               m_skins[f].ledger().start_mass_kg());
        loads[f].progress = std::min(1.0, (time_h() + hours) / (24 * m_parameters.body.softening_days));
        loads[f].rot = rot[f];
    }
    m_bodies->advance(loads);
    if (m_skins.size() > 1) infect_neighbours();
    ++m_frame;
}

std::vector<std::byte> RottingPile::save() const {
    BodyWriter writer;
    writer(static_cast<std::int64_t>(m_frame));
    for (std::size_t f = 0; f < m_skins.size(); ++f) {
        writer(m_bodies->bodies()[f].save());
        writer(m_skins[f].save());
    }
    return writer.take();
}

void RottingPile::restore(std::span<const std::byte> state) {
    BodyReader reader(state);
    std::int64_t frame = 0;
    reader(frame);
    m_frame = static_cast<int>(frame);
    for (std::size_t f = 0; f < m_skins.size(); ++f) {
        std::vector<std::byte> body, skin;
        reader(body);
        reader(skin);
        m_bodies->bodies()[f].restore(body);
        m_skins[f].restore(skin);
    }
}

}  // namespace windfall::decay
