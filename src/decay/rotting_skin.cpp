#include "decay/rotting_skin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "decay/body_archive.h"
#include "decay/organisms_of.h"
#include "decay/raw_maps.h"
#include "decay/rot_front.h"
#include "water/transpiration.h"

namespace windfall::decay {
namespace {

constexpr double kSecondsPerHour = 3600;
// Density of soft rot that counts as thorough rot (its growth stops at 0.3), and from which a neighbour
// catches it.
constexpr float kThoroughRot = 0.3F;
constexpr double kCatching = 0.1;
// Densities between which the front of rot or mold is looked for.
constexpr double kFrontLow = 0.02, kFrontHigh = 0.10;
constexpr double kContactRadius_m = 0.004, kContactNutrient = 1.25, kStartStrength = 0.3;
// Solids of fruit are mostly sugars; kg a mole of hexose, and of water.
constexpr double kHexose_kg_mol = 0.180, kWater_kg_mol = 0.018;
// Water activity in rot and wounds of fresh fruit.
constexpr double kFreshActivity = 0.99;

std::vector<geometry::Vec3> texel_points(const geometry::CubeAtlas& atlas, const SurfaceFunction& surface) {
    std::vector<geometry::Vec3> points(atlas.texel_count(), geometry::Vec3::Zero());
    for (const geometry::CubeAtlas::Run& run : atlas.runs())
        for (std::size_t i = run.begin; i < run.end; ++i) points[i] = surface(atlas.texel_direction(i));
    return points;
}

Growth make_growth(const DecayParameters& parameters, const geometry::CubeAtlas& atlas,
                   const SurfaceFunction& surface, const SkinStarts& starts, std::uint64_t seed) {
    const std::vector<geometry::Vec3> points = texel_points(atlas, surface);
    // Wounds and contacts are wet; juice that oozes out where a fruit is pressed is food.
    std::vector<float> wetness(points.size(), 0), nutrient(points.size(), 1);
    for (const geometry::Vec3& d : starts.wounds)
        wet_around(atlas, points, surface(d), 2 * parameters.start.radius_m, wetness);
    if (!starts.contacts.empty()) {
        std::vector<float> pressed(points.size(), 0);
        for (const geometry::Vec3& d : starts.contacts)
            wet_around(atlas, points, surface(d), kContactRadius_m, pressed);
        for (std::size_t i = 0; i < points.size(); ++i) {
            wetness[i] = std::max(wetness[i], pressed[i]);
            nutrient[i] += static_cast<float>(kContactNutrient - 1) * pressed[i];
        }
    }
    return {
        atlas, points, organisms_of(parameters), growth_settings_of(parameters), seed, {wetness, nutrient}};
}

}  // namespace

RottingSkin::RottingSkin(const DecayParameters& parameters, const geometry::CubeAtlas& atlas,
                         const SurfaceFunction& surface, const SkinStarts& starts, double relative_mass,
                         std::uint64_t seed)
    : m_atlas(atlas),
      m_growth(make_growth(parameters, atlas, surface, starts, seed)),
      m_colonies(colony_settings_of(parameters), seed),
      m_ledger(relative_mass * parameters.fruit.mass_kg, relative_mass * parameters.fruit.water_kg),
      m_transpiration(parameters.water.transpiration_ug_s_m2_pa),
      m_rot_leak(parameters.water.rot_leak) {
    m_start_total = m_growth.total();
    const auto begin_at = [&](const geometry::Vec3& direction) {
        for (std::size_t o = 0; o < m_growth.organism_count(); ++o)
            m_colonies.start(m_growth, {surface(direction), o, kStartStrength, parameters.start.radius_m});
    };
    for (const geometry::Vec3& d : starts.wounds) begin_at(d);
    if (parameters.start.contacts)
        for (const geometry::Vec3& d : starts.contacts) begin_at(d);
    m_planted = m_growth.total() - m_start_total;
}

double RottingSkin::water_activity() const {
    // Raoult's law: sap thickens as it dries. Relative to the fresh fruit, whose wet places are free water
    // for an organism in all but a trace.
    const double solutes = m_ledger.solids_kg() / kHexose_kg_mol;
    const auto share_of_water = [&](double water_kg) {
        const double water = water_kg / kWater_kg_mol;
        return water / (water + solutes);
    };
    return kFreshActivity * share_of_water(m_ledger.water_left_kg()) /
           share_of_water(m_ledger.start_water_kg());
}

void RottingSkin::grow(double hours, const water::Air& air) {
    m_growth.advance(hours, {air.temperature_c, air.relative_humidity, water_activity()});
    const std::size_t before = m_colonies.list().size();
    const double total = m_growth.total();
    m_colonies.spread(m_growth);
    if (m_colonies.list().size() != before) m_planted += m_growth.total() - total;
}

void RottingSkin::lose_water(double hours, double area_m2, const water::Air& air) {
    const double skin = m_growth.area_over(0, -1), rotten = m_growth.area_over(0, kCatching);
    const double leak = 1 + (m_rot_leak - 1) * rotten / skin;
    m_ledger.take(
        hours * kSecondsPerHour * leak *
        water::transpiration_kg_per_s({m_transpiration, area_m2, air.temperature_c, air.temperature_c,
                                       air.relative_humidity, water_activity()}));
}

bool RottingSkin::is_rotten(const geometry::Vec3& direction) const {
    const std::size_t texel = m_atlas.texel_at(direction);
    return m_growth.active(0)[texel] + m_growth.inactive(0)[texel] > kCatching;
}

void RottingSkin::infect(const geometry::Vec3& direction) {
    if (is_rotten(direction)) return;
    const std::size_t texel = m_atlas.texel_at(direction);
    const double total = m_growth.total();
    for (std::size_t o = 0; o < m_growth.organism_count(); ++o)
        m_colonies.start(m_growth, {m_growth.positions_m()[texel], o, kStartStrength, 0.0015});
    m_planted += m_growth.total() - total;
}

std::vector<float> RottingSkin::rot_at(std::span<const geometry::Vec3> directions) const {
    std::vector<float> rot(m_atlas.texel_count());
    const auto active = m_growth.active(0), inactive = m_growth.inactive(0);
    for (std::size_t i = 0; i < rot.size(); ++i)
        rot[i] = std::min(1.0F, (active[i] + inactive[i]) * (1 / kThoroughRot));
    m_atlas.bleed(rot);
    std::vector<float> result(directions.size());
    for (std::size_t v = 0; v < directions.size(); ++v) result[v] = m_atlas.sample(rot, directions[v]);
    return result;
}

std::vector<take::FrameMap> RottingSkin::maps(const std::string& mesh, const SkinForm& form) const {
    return raw_maps(m_atlas, m_growth, mesh, form.bake(), form.texels());
}

std::map<std::string, double> RottingSkin::numbers() const {
    std::map<std::string, double> numbers{
        {"mass_kg", m_ledger.mass_kg()},
        {"water_lost_kg", m_ledger.lost_kg()},
        {"ledger_error", m_ledger.error()},
        {"skin_m2", m_growth.area_over(0, -1)},
        {"colonies", static_cast<double>(m_colonies.list().size())},
        {"conservation_error", (m_growth.total() - m_start_total - m_planted) / m_start_total},
    };
    Front mold;
    for (std::size_t o = 0; o < m_growth.organism_count(); ++o) {
        const Front front = front_of(m_atlas, m_growth, o, kFrontLow, kFrontHigh);
        if (o == 0) {
            numbers["rot_m2"] = front.area_m2;
            numbers["rot_front_m"] = front.length_m;
        } else {
            mold.area_m2 += front.area_m2;
            mold.length_m += front.length_m;
        }
    }
    numbers["mold_m2"] = mold.area_m2;
    numbers["mold_front_m"] = mold.length_m;
    return numbers;
}

std::vector<std::byte> RottingSkin::save() const {
    BodyWriter writer;
    writer(m_growth.save());
    writer(m_colonies.save());
    writer(m_ledger.lost_kg());
    writer(m_ledger.water_left_kg());
    writer(m_start_total);
    writer(m_planted);
    return writer.take();
}

void RottingSkin::restore(std::span<const std::byte> state) {
    BodyReader reader(state);
    std::vector<std::byte> growth, colonies;
    reader(growth);
    reader(colonies);
    m_growth.restore(growth);
    m_colonies.restore(colonies);
    double lost = 0, left = 0;
    reader(lost);
    reader(left);
    m_ledger.restore(lost, left);
    reader(m_start_total);
    reader(m_planted);
}

}  // namespace windfall::decay
