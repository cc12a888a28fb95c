#include "drying/moisture_course.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "water/climate_settings.h"
#include "water/transpiration.h"
#include "water/vapour_pressure.h"

namespace windfall::drying {

namespace {

using geometry::Vec3;

constexpr double kSecondsPerHour = 3600;
constexpr double kWaterDensity_kg_m3 = 1000;
// Steps of the diffusion: by how much the content of a cell may change in one, and how long one may be while
// the air changes.
constexpr double kContentPerStep = 0.01;
constexpr double kHoursPerStep = 1;
constexpr double kFirstStep_h = 1.0 / 60;
constexpr double kShortestStep_h = 1e-9;

// A state's values: contents of the cells, the volume of water lost in r_1^3, and the length of the
// diffusion's next step in hours.
constexpr std::size_t kExtraValues = 2;
double& lost_of(std::vector<double>& values) { return values[values.size() - 2]; }
double lost_of(const std::vector<double>& values) { return values[values.size() - 2]; }
double& step_of(std::vector<double>& values) { return values.back(); }

double largest_difference(const std::vector<double>& a, const std::vector<double>& b, std::size_t count) {
    double result = 0;
    for (std::size_t i = 0; i < count; ++i) result = std::max(result, std::abs(a[i] - b[i]));
    return result;
}

}  // namespace

MoistureCourse::MoistureCourse(const geometry::LayeredMesh& mesh, const DryingParameters& parameters,
                               SkinExposure exposure)
    : m_drying(mesh, parameters.drying),
      m_moisture(parameters.moisture),
      m_largest_shrinkage(parameters.drying.shrinkage),
      m_size_m(parameters.fruit.size_m),
      m_flesh_layers(mesh.flesh_layers),
      m_cells(mesh),
      m_exposure(std::move(exposure)),
      m_climate(water::climate_of(parameters.climate)),
      m_fresh_water(1 - parameters.moisture.solids_fraction()),
      // Such that fresh sap has the activity of src/water.
      m_solutes(m_fresh_water * (1 / water::kSapVapourRatio - 1)) {}

CourseState MoistureCourse::start() const {
    CourseState state;
    state.values.assign(m_cells.size() + kExtraValues, m_fresh_water);
    lost_of(state.values) = 0;
    step_of(state.values) = kFirstStep_h;
    return state;
}

SkinEvaporation MoistureCourse::evaporation_at(double hour, const std::vector<double>& areas) const {
    const double clock = m_moisture.start_hour + hour;
    const water::Air air = m_climate.at(clock);
    // kg/(s m2 Pa) to r_1/(s Pa) of liquid water
    const double conductance = 1e-9 * m_moisture.transpiration_ug_s_m2_pa / kWaterDensity_kg_m3 / m_size_m;
    const double warming = m_moisture.sun_warming_k * daylight(m_moisture.sunshine, clock);
    const double shaded_pa = water::saturation_pressure_pa(air.temperature_c);
    const double air_pa = water::vapour_pressure_pa(air.temperature_c, air.relative_humidity);
    SkinEvaporation result{std::vector<double>(areas.size()), std::vector<double>(areas.size()), m_solutes};
    for (std::size_t q = 0; q < areas.size(); ++q) {
        const double warmer = warming * m_exposure.sun[q];
        const double skin_pa =
            warmer > 0 ? water::saturation_pressure_pa(air.temperature_c + warmer) : shaded_pa;
        const double per_pa = conductance * m_exposure.transpiration[q] * areas[q];
        result.leaving[q] = per_pa * skin_pa;
        result.arriving[q] = per_pa * air_pa;
    }
    return result;
}

std::vector<double> MoistureCourse::shrinkages(const CourseState& state) const {
    std::vector<double> result(m_cells.size());
    const double solids = 1 - m_fresh_water;
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] =
            std::min(m_largest_shrinkage, m_drying.shrinkage_for(solids + std::max(0.0, state.values[i])));
    return result;
}

DryingField MoistureCourse::field_of(std::vector<double> shrinkages) const {
    // The skin shrinks with the flesh below it, as far as it shrinks at all.
    const auto shared = std::make_shared<const std::vector<double>>(std::move(shrinkages));
    const auto layers = static_cast<std::size_t>(m_flesh_layers);
    return [this, shared, layers](std::size_t quad, int layer) {
        const std::size_t cell = quad * layers + std::min(static_cast<std::size_t>(layer), layers - 1);
        return m_drying.element(quad, layer, (*shared)[cell]);
    };
}

DryingField MoistureCourse::field(const CourseState& state) const { return field_of(shrinkages(state)); }

CourseIncrement MoistureCourse::increment(const CourseState& from, double target, double largest_change,
                                          const BodyNodes& body) const {
    constexpr double kNearlyAll = 0.9;  // of the change that is allowed: near enough to stop
    constexpr double kLittleMore = 1.02;
    const std::vector<Vec3> nodes = body();
    const FleshConductances conductances = m_cells.conductances(nodes);
    const std::vector<double> areas = m_cells.skin_areas(nodes);
    const FleshDiffusion diffusion(m_cells, conductances,
                                   m_moisture.diffusivity_m2_s / (m_size_m * m_size_m));
    const bool steady_air = m_climate.rows().size() == 1 &&
                            (m_moisture.sunshine == Sunshine::Always || m_moisture.sun_direction.empty());
    const std::vector<double> shrunk_before = shrinkages(from);
    // Failed increments are repeated with a small change; the diffusion's steps then grow small as well.
    const double content_per_step = std::min(kContentPerStep, 3 * largest_change);

    CourseIncrement result;
    result.to = from;
    CourseState& now = result.to;
    std::vector<double> shrunk = shrunk_before;
    while (now.parameter < target - kSameParameter && result.change < kNearlyAll * largest_change) {
        const double left = target - now.parameter;
        double planned = step_of(now.values);
        if (!steady_air) planned = std::min(planned, kHoursPerStep);
        // Two steps of half the way rather than one long and one tiny.
        double step = planned >= left ? left : std::min(planned, std::max(0.5 * left, 0.1 * planned));
        CourseState next = now;
        std::vector<double> contents(next.values.begin(), next.values.end() - kExtraValues);
        const double volume_lost =
            diffusion.step(contents, step * kSecondsPerHour,
                           evaporation_at(now.parameter + FleshDiffusion::kFirstStage * step, areas),
                           evaporation_at(now.parameter + step, areas));
        std::copy(contents.begin(), contents.end(), next.values.begin());
        next.parameter = step == left ? target : now.parameter + step;
        lost_of(next.values) += volume_lost;
        const double moved = largest_difference(now.values, next.values, m_cells.size());
        const bool negative = *std::min_element(contents.begin(), contents.end()) < -1e-6;
        std::vector<double> shrunk_next = shrinkages(next);
        const double change = largest_difference(shrunk_before, shrunk_next, m_cells.size());
        const bool too_far = change > kLittleMore * largest_change;
        if ((moved > 2 * content_per_step || negative || too_far) && step > kShortestStep_h) {
            const double shorter = too_far ? (largest_change - result.change) / (change - result.change)
                                           : content_per_step / moved;
            step_of(now.values) = step * std::clamp(0.95 * shorter, 0.1, 0.8);
            continue;
        }
        const double growth = moved > 0 ? std::clamp(0.9 * content_per_step / moved, 0.5, 2.0) : 2.0;
        // A step that was short only because the target was near says nothing against the longer one.
        step_of(next.values) = step < planned && growth >= 1 ? planned : step * growth;
        now = std::move(next);
        shrunk = std::move(shrunk_next);
        result.change = change;
    }
    result.cut_at_target = result.change < kNearlyAll * largest_change;
    now.shrinkage = 0;
    for (std::size_t i = 0; i < shrunk.size(); ++i)
        now.shrinkage += shrunk[i] * m_cells.volumes()[i] / m_cells.volume();
    result.field = field_of(std::move(shrunk));
    return result;
}

double MoistureCourse::kg_of(double volume) const {
    return kWaterDensity_kg_m3 * volume * m_size_m * m_size_m * m_size_m;
}

water::WaterLedger MoistureCourse::ledger(const CourseState& state) const {
    double left = 0;
    for (std::size_t i = 0; i < m_cells.size(); ++i) left += m_cells.volumes()[i] * state.values[i];
    const double water_kg = kg_of(m_fresh_water * m_cells.volume());
    water::WaterLedger ledger(water_kg / m_moisture.water, water_kg);
    ledger.restore(kg_of(lost_of(state.values)), kg_of(left));
    return ledger;
}

std::map<std::string, double> MoistureCourse::measures(const CourseState& state) const {
    constexpr double kGramsPerKg = 1000;
    const water::WaterLedger water = ledger(state);
    const auto [driest, wettest] =
        std::minmax_element(state.values.begin(), state.values.end() - kExtraValues);
    const std::vector<double> shrunk = shrinkages(state);
    const auto [least, most] = std::minmax_element(shrunk.begin(), shrunk.end());
    return {
        {"hours", state.parameter},
        {"water_lost_g", kGramsPerKg * water.lost_kg()},
        {"water_left_g", kGramsPerKg * water.water_left_kg()},
        {"solids_g", kGramsPerKg * water.solids_kg()},
        {"water_lost_percent", 100 * water.lost_fraction()},
        {"ledger_error", water.error()},
        {"moisture_min", *driest / m_fresh_water},
        {"moisture_max", *wettest / m_fresh_water},
        {"shrinkage_min", *least},
        {"shrinkage_max", *most},
    };
}

std::vector<double> MoistureCourse::skin_moisture(const CourseState& state) const {
    std::vector<double> result(m_cells.quads());
    for (std::size_t q = 0; q < result.size(); ++q)
        result[q] = state.values[(q + 1) * m_cells.layers() - 1] / m_fresh_water;
    return result;
}

std::vector<double> MoistureCourse::skin_dryness(const CourseState& state) const {
    std::vector<double> result(m_cells.quads());
    const std::vector<double> shrunk = shrinkages(state);
    for (std::size_t q = 0; q < result.size(); ++q)
        result[q] = shrunk[(q + 1) * m_cells.layers() - 1] / m_largest_shrinkage;
    return result;
}

}  // namespace windfall::drying
