#include "drying/newton.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace windfall::drying {

namespace {

constexpr std::size_t kNewtonBlock = std::size_t{1} << 13U;
// A step may leave the potential higher by its rounding error, no more.
constexpr double kRounding = 1e-12;

double norm(const AlignedArray<double>& a) {
    return std::sqrt(parallel_sum(a.size(), kNewtonBlock, [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t i = begin; i < end; ++i) sum += a[i] * a[i];
        return sum;
    }));
}

/// to = from + part (to - from)
void draw_back(AlignedArray<double>& to, const AlignedArray<double>& from, double part) {
    parallel_blocks(to.size(), kNewtonBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) to[i] = from[i] + part * (to[i] - from[i]);
    });
}

bool accepts(double trial_potential, double start_potential) {
    return trial_potential <= start_potential + kRounding * std::abs(start_potential);
}

}  // namespace

bool NewtonSolver::State::valid() const { return std::isfinite(potential); }

NewtonSolver::NewtonSolver(Elasticity& elasticity, SkinContact* contact)
    : m_elasticity(elasticity),
      m_contact(contact),
      m_linear(
          elasticity.multigrid(), elasticity.mean_weights(),
          contact == nullptr ? AddedProduct()
                             : [contact](const float* x, float* y) { return contact->add_product(x, y); }),
      m_current(elasticity.size()),
      m_trial(elasticity.size()),
      m_corrected(elasticity.size()),
      m_right(elasticity.size()),
      m_step(elasticity.size()) {}

double NewtonSolver::damping_energy(const AlignedArray<double>& displacement, const Damping& damping,
                                    AlignedArray<double>* force) const {
    if (damping.factor == 0) return 0;
    const auto layers = static_cast<std::size_t>(m_elasticity.multigrid().layers());
    const AlignedArray<double>& mass = m_elasticity.mass();
    const AlignedArray<double>& from = *damping.from;
    const std::size_t columns = mass.size() / layers;
    const double sum = parallel_sum(columns, kNewtonBlock / 16, [&](std::size_t begin, std::size_t end) {
        double partial = 0;
        for (std::size_t c = begin; c < end; ++c)
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t k = 0; k < layers; ++k) {
                    const std::size_t at = (3 * c + i) * layers + k;
                    const double difference = displacement[at] - from[at];
                    const double weighted = mass[c * layers + k] * difference;
                    partial += weighted * difference;
                    if (force != nullptr) (*force)[at] += damping.factor * weighted;
                }
        return partial;
    });
    return 0.5 * damping.factor * sum;
}

void NewtonSolver::evaluate(State& state, const Damping& damping, const State* from) {
    const PhaseTimer timer(m_times.energy_s);
    ElasticEnergy elastic = m_elasticity.energy(state.displacement, &state.force);
    if (m_contact != nullptr && from != nullptr && elastic.valid()) {
        const double part = m_contact->free_part(from->displacement, state.displacement);
        if (part < 1) {
            draw_back(state.displacement, from->displacement, part);
            elastic = m_elasticity.energy(state.displacement, &state.force);
        }
    }
    state.elastic_energy = elastic.energy;
    state.smallest_volume_ratio = elastic.smallest_volume_ratio;
    state.potential = elastic.valid()
                          ? elastic.energy + damping_energy(state.displacement, damping, &state.force)
                          : std::numeric_limits<double>::infinity();
    state.contact = {};
    if (m_contact != nullptr && elastic.valid()) {
        state.contact = m_contact->energy(state.displacement, &state.force);
        state.potential += state.contact.energy;
    }
    state.force_norm = elastic.valid() ? norm(state.force) : std::numeric_limits<double>::infinity();
}

double NewtonSolver::potential(const AlignedArray<double>& displacement, const Damping& damping) {
    const PhaseTimer timer(m_times.energy_s);
    const ElasticEnergy elastic = m_elasticity.energy(displacement, nullptr);
    if (!elastic.valid()) return std::numeric_limits<double>::infinity();
    return elastic.energy + damping_energy(displacement, damping, nullptr) +
           (m_contact == nullptr ? 0 : m_contact->energy(displacement, nullptr).energy);
}

LinearResult NewtonSolver::linear_step(const State& at, double tolerance, int max_iterations, double radius,
                                       double reference_force, const RunContext& context) {
    const PhaseTimer timer(m_times.linear_solver_s);
    parallel_blocks(m_right.size(), kNewtonBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            m_right[i] = static_cast<float>(-at.force[i] / reference_force);
    });
    return m_linear.solve(m_right, m_step, tolerance, max_iterations, radius / reference_force, context);
}

LinearResult NewtonSolver::newton_step(const State& at, const Damping& damping, double tolerance,
                                       double radius, const NewtonSettings& settings,
                                       const RunContext& context, bool& indefinite) {
    // Where the exact tangent is so indefinite that not even the blocks of the smoother are definite, its
    // stress terms are scaled down, a little more each time and in the end to nothing, which leaves a
    // definite matrix. The direction found is still one of descent.
    LinearResult result;
    result.status = LinearStatus::NotDefinite;
    if (m_contact != nullptr) m_contact->linearize(at.displacement);
    for (const double softening : {0.0, 0.02, 0.04, 0.08, 0.16, 0.32, 0.64, 1.0}) {
        {
            const PhaseTimer timer(m_times.assembly_s);
            m_elasticity.assemble(at.displacement, 1 - softening, damping.factor);
            if (m_contact != nullptr) m_contact->add_to_diagonal(m_elasticity.multigrid().matrix());
        }
        bool definite = false;
        {
            const PhaseTimer timer(m_times.multigrid_setup_s);
            definite = m_elasticity.multigrid().set_up();
        }
        if (definite)
            result = linear_step(at, tolerance, settings.max_linear_iterations, radius,
                                 settings.reference_force, context);
        if (result.status != LinearStatus::NotDefinite) return result;
        indefinite = true;
        context.throw_if_cancelled();
    }
    return result;
}

void NewtonSolver::take_step(const State& from, State& to, double reference_force) const {
    parallel_blocks(m_step.size(), kNewtonBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            to.displacement[i] = from.displacement[i] + reference_force * static_cast<double>(m_step[i]);
    });
}

/// Second-order corrections: near incompressibility makes a curved valley, which a straight step leaves. A
/// few more linear iterations with the same matrix lead back to its floor. Returns how many were taken.
int NewtonSolver::correct(State& trial, const State& start, double step_length, const Damping& damping,
                          const NewtonSettings& settings, const RunContext& context, int& linear_iterations) {
    constexpr int kIterations = 4;
    constexpr double kTolerance = 0.1;
    int corrections = 0;
    const double accepted_force = settings.tolerance * settings.reference_force;
    const auto needs_correction = [&] {
        const bool higher = !accepts(trial.potential, start.potential);
        const bool rougher = trial.force_norm > start.force_norm && trial.force_norm > accepted_force;
        return trial.valid() && (higher || rougher);
    };
    while (corrections < settings.max_corrections && needs_correction()) {
        ++corrections;
        const LinearResult linear =
            linear_step(trial, kTolerance, kIterations, 0.5 * step_length, settings.reference_force, context);
        linear_iterations += linear.iterations;
        if (linear.status == LinearStatus::NotDefinite) break;
        take_step(trial, m_corrected, settings.reference_force);
        evaluate(m_corrected, damping, &trial);
        if (!(m_corrected.potential < trial.potential)) break;
        std::swap(trial, m_corrected);
    }
    return corrections;
}

/// The quadratic model knows nothing of pairs that only now come closer than the gap: halves a step that
/// they pushed uphill. False where that does not help.
bool NewtonSolver::shorten(State& trial, const State& start, const Damping& damping) {
    constexpr int kHalvings = 6;
    for (int i = 0; i < kHalvings && trial.valid() && trial.contact.pairs > 0; ++i) {
        draw_back(trial.displacement, start.displacement, 0.5);
        evaluate(trial, damping, &start);
        if (trial.valid() && accepts(trial.potential, start.potential)) return true;
    }
    return false;
}

NewtonResult NewtonSolver::minimize(AlignedArray<double>& displacement, const Damping& damping,
                                    const NewtonSettings& settings, const RunContext& context) {
    constexpr double kLoosest =
        0.1;  // forcing terms: tolerances of the linear solver (Eisenstat and Walker 1996)
    constexpr double kTightest = 3e-3;
    constexpr double kShrink = 0.35;
    constexpr double kLargestGrowth = 8;
    std::swap(m_current.displacement, displacement);
    evaluate(m_current, damping);
    NewtonResult result;
    result.potentials.push_back(m_current.potential);
    double radius = settings.radius;
    double last_norm = 3 * m_current.force_norm;
    bool rejected = false;
    const auto at_minimum = [&] {
        return m_current.force_norm < settings.tolerance * settings.reference_force;
    };
    while (m_current.valid() && !at_minimum() && result.newton_steps < settings.max_iterations &&
           result.rejections < settings.max_rejections) {
        ++result.newton_steps;
        const double forcing =
            std::clamp(0.5 * std::pow(m_current.force_norm / last_norm, 1.5), kTightest, kLoosest);
        // After a rejected step the matrix still is that of the current state; only the radius has shrunk.
        const LinearResult linear =
            rejected ? linear_step(m_current, forcing, settings.max_linear_iterations, radius,
                                   settings.reference_force, context)
                     : newton_step(m_current, damping, forcing, radius, settings, context, result.indefinite);
        result.linear_iterations += linear.iterations;
        if (linear.status == LinearStatus::NotDefinite) break;
        if (linear.status == LinearStatus::NegativeCurvature) result.indefinite = true;
        const double step_length = m_linear.length(m_step) * settings.reference_force;
        take_step(m_current, m_trial, settings.reference_force);
        evaluate(m_trial, damping, &m_current);
        const int corrections =
            correct(m_trial, m_current, step_length, damping, settings, context, result.linear_iterations);
        rejected = !(m_trial.valid() && accepts(m_trial.potential, m_current.potential)) &&
                   !shorten(m_trial, m_current, damping);
        if (!rejected) {
            last_norm = m_current.force_norm;
            std::swap(m_current, m_trial);
            result.potentials.push_back(m_current.potential);
            const bool limited =
                linear.status == LinearStatus::OnBoundary || linear.status == LinearStatus::NegativeCurvature;
            if (limited)
                radius = std::min(radius * (corrections <= 1 ? 2.0 : 1.3), kLargestGrowth * settings.radius);
        } else {
            ++result.rejections;
            radius = kShrink * step_length;
            last_norm = 3 * m_current.force_norm;
        }
    }
    result.converged = m_current.valid() && at_minimum();
    result.potential = m_current.potential;
    result.elastic_energy = m_current.elastic_energy;
    result.contact = m_current.contact;
    result.smallest_volume_ratio = m_current.smallest_volume_ratio;
    result.residual = m_current.force_norm / settings.reference_force;
    std::swap(m_current.displacement, displacement);
    return result;
}

}  // namespace windfall::drying
