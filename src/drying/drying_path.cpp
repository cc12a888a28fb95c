#include "drying/drying_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "drying/slow_motion.h"
#include "drying/specimen.h"
#include "drying/viscosity.h"

namespace windfall::drying {

namespace {

using geometry::Vec3;

// Step control, measured on the base case (docs/drying.md): fewer failures do not pay for smaller steps.
constexpr double kSmallestStep = 1e-6;
constexpr double kUnmoved = 1e-9;  // change of shrinkage that is none
constexpr double kCutAfterFailure = 0.45;
constexpr double kCutAfterSlow = 0.7;
constexpr double kGrowthAfterFast = 1.3;
constexpr double kGrowthAfterFastest = 2;
constexpr int kFastestNewton = 2;
constexpr int kFastNewton = 4;
constexpr int kSlowNewton = 6;
constexpr double kOnsetDepth = 0.1;  // of t_e

double norm_of(const AlignedArray<double>& a) {
    double sum = 0;
    for (const double x : a) sum += x * x;
    return std::sqrt(sum);
}

/// [value(i)] for i in [0, size)
template <class Value>
AlignedArray<double> make_array(std::size_t size, const Value& value) {
    constexpr std::size_t kBlock = std::size_t{1} << 14U;
    AlignedArray<double> result(size);
    parallel_blocks(size, kBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) result[i] = value(i);
    });
    return result;
}

/// (u - a) M (u - b)
double mass_product(const AlignedArray<double>& mass, std::size_t layers, const AlignedArray<double>& u,
                    const AlignedArray<double>& a, const AlignedArray<double>& b) {
    constexpr std::size_t kColumns = 512;
    return parallel_sum(mass.size() / layers, kColumns, [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t at = begin * 3 * layers; at < end * 3 * layers; ++at)
            sum += mass[at / (3 * layers) * layers + at % layers] * (u[at] - a[at]) * (u[at] - b[at]);
        return sum;
    });
}

}  // namespace

DryingPath::DryingPath(geometry::LayeredMesh mesh, const DryingParameters& parameters)
    : DryingPath(std::move(mesh), parameters, nullptr) {}

DryingPath::DryingPath(geometry::LayeredMesh mesh, const DryingParameters& parameters,
                       std::unique_ptr<DryingCourse> course)
    : m_mesh(std::move(mesh)),
      m_parameters(parameters),
      m_drying(m_mesh, parameters.drying),
      m_course(std::move(course)),
      m_walls(wall_parts(m_mesh, parameters.segments)),
      m_moduli(layer_moduli(m_mesh.flesh_layers, m_mesh.layers, parameters.material.gamma,
                            parameters.material.bulk_ratio)),
      m_fibres(make_fibres(m_mesh, parameters.fibres, m_moduli)) {
    if (m_course == nullptr)
        m_course = std::make_unique<GivenShrinkage>(m_drying, parameters.drying.shrinkage);
    m_state.course = m_course->start();
    m_multigrid = std::make_unique<Multigrid>(m_mesh.brick, m_mesh.layers, kernels(m_mesh.layers));
    m_elasticity = std::make_unique<Elasticity>(m_mesh, m_moduli, *m_multigrid, flesh_stiffening(), m_fibres);
    if (parameters.contact.gap > 0)
        m_contact = std::make_unique<SkinContact>(m_mesh, m_multigrid->order(),
                                                  parameters.contact.gap * parameters.fruit.skin_thickness,
                                                  parameters.contact.stiffness);
    m_newton = std::make_unique<NewtonSolver>(*m_elasticity, m_contact.get());
    m_skin_rest = m_mesh.level_positions(m_mesh.layers);
    m_skin_areas = geometry::vertex_areas(m_skin_rest, m_mesh.faces());
    m_slow = std::make_unique<geometry::SlowField>(m_mesh.directions, m_skin_areas, m_mesh.slow_functions);
    m_state.next_step = parameters.solver.max_step;
    m_state.displacements.emplace_back(m_elasticity->size());

    // The force that a first small shrinkage puts out of balance is dominated by volume change; over the bulk
    // ratio it is of the size of the shear forces that shape the wrinkles.
    constexpr double kReferenceShrinkage = 0.01;
    AlignedArray<double> force(m_elasticity->size());
    m_elasticity->set_drying(drying_field_at(kReferenceShrinkage));
    m_elasticity->energy(m_state.displacements.front(), &force);
    m_reference_force = norm_of(force) / parameters.material.bulk_ratio;
}

double DryingPath::onset() const {
    const double threshold = kOnsetDepth * m_parameters.fruit.skin_thickness;
    StepRecord before;
    for (const StepRecord& record : m_state.history) {
        if (record.depth_rms > threshold) {
            const double fraction = (threshold - before.depth_rms) / (record.depth_rms - before.depth_rms);
            return before.shrinkage + fraction * (record.shrinkage - before.shrinkage);
        }
        before = record;
    }
    return -1;
}

AlignedArray<double> DryingPath::predict(double step) const {
    // Lagrange extrapolation through the last two or three equilibria.
    const auto& u = m_state.displacements;
    if (m_state.past_steps.empty()) return u[0];
    const double h0 = m_state.past_steps[0];
    if (m_state.past_steps.size() == 1) {
        const double factor = step / h0;
        return make_array(u[0].size(), [&](std::size_t i) { return u[0][i] + factor * (u[0][i] - u[1][i]); });
    }
    const double h1 = m_state.past_steps[1];
    const double c0 = (step + h0) * (step + h0 + h1) / (h0 * (h0 + h1));
    const double c1 = -step * (step + h0 + h1) / (h0 * h1);
    const double c2 = step * (step + h0) / ((h0 + h1) * h1);
    return make_array(u[0].size(), [&](std::size_t i) { return c0 * u[0][i] + c1 * u[1][i] + c2 * u[2][i]; });
}

AlignedArray<double> DryingPath::drift(double step) const {
    constexpr double kMostGrowth = 2;  // a step that was cut for a frame says little about a long one
    // Where wrinkles are as long as the slow functions, the latter would leave them undamped.
    constexpr double kLongestWave = 1;
    const auto& u = m_state.displacements;
    if (m_state.past_steps.empty() || expected_wave_length(m_parameters) > kLongestWave) return u[0];
    const double factor = std::min(kMostGrowth, step / m_state.past_steps[0]);
    const AlignedArray<double> motion =
        slow_motion(*m_slow, m_multigrid->order(), static_cast<std::size_t>(m_mesh.layers), u[1], u[0]);
    return make_array(u[0].size(), [&](std::size_t i) { return u[0][i] + factor * motion[i]; });
}

bool DryingPath::goes_back(const CourseIncrement& increment) const {
    const double change = increment.to.shrinkage - m_state.course.shrinkage;
    double later = m_state.course.shrinkage;
    for (std::size_t i = m_state.history.size(); i-- > 0;) {
        const double before = m_state.history[i].shrinkage;
        if (later != before) return (later - before) * change < 0;
        later = before;
    }
    return later * change < 0;
}

bool DryingPath::attempt(double target, const RunContext& context) {
    // Of the course's state nothing is kept until the increment is accepted, so a shorter one starts afresh.
    CourseIncrement increment =
        m_course->increment(m_state.course, target, m_state.next_step, [this] { return positions(); });
    const double step = increment.change;
    StepRecord& record = m_state.pending;
    if (step < kUnmoved) {
        // Nothing has shrunk, so nothing moves: a cool night.
        const StepRecord last = m_state.history.empty() ? StepRecord{} : m_state.history.back();
        record = {increment.to.parameter, increment.to.shrinkage,   last.depth_rms,
                  last.elastic_energy,    last.viscous_work,        last.smallest_volume_ratio,
                  record.newton_steps,    record.linear_iterations, record.failures,
                  last.contacts};
        m_state.course = std::move(increment.to);
        return true;
    }
    const AlignedArray<double>& start = m_state.displacements.front();
    const AlignedArray<double> drifted = goes_back(increment) ? start : drift(step);
    const Damping damping{
        &drifted, viscosity(m_parameters, shrinkage(), onset()) * m_parameters.drying.shrinkage / step};
    const DryingField drying = walled(increment.field);
    m_elasticity->set_drying(with_set(drying, m_state.set, m_mesh.layers), drying);
    AlignedArray<double> displacement = predict(step);
    if (m_contact != nullptr) {
        const double part = m_contact->free_part(start, displacement);
        for (std::size_t i = 0; part < 1 && i < start.size(); ++i)
            displacement[i] = start[i] + part * (displacement[i] - start[i]);
    }
    if (!(m_newton->potential(displacement, damping) < m_newton->potential(start, damping)))
        displacement = start;

    NewtonSettings settings;
    settings.tolerance = m_parameters.solver.newton_tolerance;
    settings.reference_force = m_reference_force;
    settings.radius = m_parameters.fruit.skin_thickness;
    const NewtonResult result = m_newton->minimize(displacement, damping, settings, context);
    record.newton_steps += result.newton_steps;
    record.linear_iterations += result.linear_iterations;
    if (!result.converged) {
        m_state.next_step = step * kCutAfterFailure;
        ++record.failures;
        return false;
    }
    // The viscous force works over the way.
    record.viscous_work =
        (m_state.history.empty() ? 0 : m_state.history.back().viscous_work) +
        damping.factor * mass_product(m_elasticity->mass(), static_cast<std::size_t>(m_mesh.layers),
                                      displacement, drifted, start);
    take(std::move(increment), std::move(displacement), result);
    return true;
}

void DryingPath::take(CourseIncrement increment, AlignedArray<double> displacement,
                      const NewtonResult& result) {
    StepRecord& record = m_state.pending;
    record.parameter = increment.to.parameter;
    record.shrinkage = increment.to.shrinkage;
    record.elastic_energy = result.elastic_energy;
    record.smallest_volume_ratio = result.smallest_volume_ratio;
    record.contacts = result.contact.pairs;
    set_step_after(increment, result);
    m_state.course = std::move(increment.to);
    m_state.displacements.insert(m_state.displacements.begin(), std::move(displacement));
    m_state.past_steps.insert(m_state.past_steps.begin(), increment.change);
    if (m_state.displacements.size() > 3) m_state.displacements.pop_back();
    if (m_state.past_steps.size() > 2) m_state.past_steps.pop_back();
    if (increment.turns) {
        // Equilibria of the way up say nothing about the way down.
        m_state.past_steps.clear();
        m_state.displacements.resize(1);
    }
    const YieldStrains yield{m_parameters.plastic.flesh_yield_strain, m_parameters.plastic.skin_yield_strain};
    if (yield.any()) flow(m_state.set, m_mesh, positions(), drying_field(), yield);
}

void DryingPath::set_step_after(const CourseIncrement& increment, const NewtonResult& result) {
    if (result.newton_steps <= kFastNewton && result.rejections == 0) {
        // A step that was short only because a frame was due says nothing against the longer one.
        const double growth = result.newton_steps <= kFastestNewton ? kGrowthAfterFastest : kGrowthAfterFast;
        m_state.next_step =
            std::min(m_parameters.solver.max_step,
                     increment.cut_at_target ? m_state.next_step : growth * m_state.next_step);
    } else if (result.newton_steps > kSlowNewton) {
        m_state.next_step = increment.change * kCutAfterSlow;
    }
}

void DryingPath::advance(double target, const RunContext& context, const std::function<void()>& on_step) {
    while (parameter() < target - kSameParameter) {
        context.throw_if_cancelled();
        if (m_state.next_step < kSmallestStep)
            throw LostEquilibrium(fmt::format(
                "equilibrium was lost at shrinkage {:.4f}: no increment above {} converged. Try a larger "
                "solver.viscosity (now {}), a larger imperfection.amplitude (now {}), a finer mesh.n, "
                "or stop at drying.shrinkage = {:.2f}",
                shrinkage(), kSmallestStep, m_parameters.solver.viscosity,
                m_parameters.imperfection.amplitude, std::floor(100 * shrinkage()) / 100));
        if (!attempt(target, context)) continue;
        m_state.pending.depth_rms = root_mean_square_depth();
        m_state.history.push_back(std::exchange(m_state.pending, {}));
        if (on_step) on_step();
    }
}

std::vector<Vec3> DryingPath::positions() const {
    std::vector<Vec3> result = m_mesh.nodes;
    const AlignedArray<double>& u = m_state.displacements.front();
    const ColumnOrder& order = m_multigrid->order();
    const auto layers = static_cast<std::size_t>(m_mesh.layers);
    for (std::size_t c = 0; c < m_mesh.columns(); ++c)
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < layers; ++k)
                result[order.vertex_of_solver[c] * layers + k][static_cast<int>(i)] +=
                    u[(3 * c + i) * layers + k];
    return result;
}

std::vector<Vec3> DryingPath::skin_positions() const {
    std::vector<Vec3> skin = m_skin_rest;
    const AlignedArray<double>& u = m_state.displacements.front();
    const auto layers = static_cast<std::size_t>(m_mesh.layers);
    for (std::size_t c = 0; c < skin.size(); ++c)
        for (std::size_t i = 0; i < 3; ++i)
            skin[m_multigrid->order().vertex_of_solver[c]][static_cast<int>(i)] +=
                u[(3 * c + i + 1) * layers - 1];
    return skin;
}

std::vector<double> DryingPath::skin_depth() const {
    return geometry::depth_below_smooth_surface(*m_slow, m_skin_rest, skin_positions(), m_mesh.faces());
}

double DryingPath::root_mean_square_depth() const {
    const std::vector<double> depth = skin_depth();
    double sum = 0;
    double area = 0;
    for (std::size_t v = 0; v < depth.size(); ++v) {
        sum += m_skin_areas[v] * depth[v] * depth[v];
        area += m_skin_areas[v];
    }
    return std::sqrt(sum / area);
}

}  // namespace windfall::drying
