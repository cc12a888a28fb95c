#include "decay/flesh_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace windfall::decay {

namespace {

/// Surface nodes so near to an obstacle get its stiffness in the preconditioner, since they may touch it
/// before the next one is made.
constexpr double kContactMargin_m = 1.0e-3;

/// Share of the contacts' stiffness that may change before the preconditioner is made anew.
constexpr double kContactChange = 0.25;

constexpr int kMostHalvings = 6;
/// Farthest that a step moves a node: a body that hangs in the air would fall by metres.
constexpr float kFarthestStep_m = 5e-3F;

/// Rounding of an energy that is summed in single precision element by element.
double rounding_of(double energy_j) { return 1e-9 * std::abs(energy_j) + 1e-12; }

}  // namespace

FleshSolver::FleshSolver(const FleshMesh& mesh, double density_kg_m3)
    : m_energy(mesh, density_kg_m3),
      m_preconditioner(mesh),
      m_next_preconditioner(mesh),
      m_positions(m_energy.last_frame()) {}

FleshSolver::~FleshSolver() {
    if (m_factoring.valid()) m_factoring.wait();
}

void FleshSolver::translate(const Eigen::Vector3f& by_m) {
    for (auto& x : m_positions) x.head<3>() += by_m;
}

FleshSolver::FactorInput FleshSolver::factor_input() const {
    return {m_energy.laplacian_weights(), m_energy.diagonal_weights(m_positions, kContactMargin_m)};
}

void FleshSolver::start_factor(FactorInput input) {
    m_next_input = std::move(input);
    m_factoring = std::async(std::launch::async, [this] {
        m_next_preconditioner.factorise(m_next_input.weights, m_next_input.diagonal);
    });
}

void FleshSolver::take_factor() {
    m_factoring.get();
    std::swap(m_preconditioner, m_next_preconditioner);
    m_input = std::exchange(m_next_input, {});
}

void FleshSolver::forget_factors() {
    if (m_factoring.valid()) m_factoring.wait();
    m_factoring = {};
    m_input = {};
    m_next_input = {};
}

bool FleshSolver::contacts_changed(const std::vector<float>& diagonal) const {
    double difference = 0;
    double sum = 0;
    for (std::size_t i = 0; i < diagonal.size(); ++i) {
        difference += std::abs(diagonal[i] - m_input.diagonal[i]);
        sum += m_input.diagonal[i];
    }
    return difference > kContactChange * sum;
}

void FleshSolver::begin_frame() {
    m_energy.begin_frame(m_positions);
    const std::int64_t age = m_frame - m_factor_frame;
    if (m_frame == 0) {
        m_input = factor_input();
        m_preconditioner.factorise(m_input.weights, m_input.diagonal);
    } else if (m_factoring.valid()) {
        if (age == kRefactorDelay) take_factor();
    } else {
        FactorInput input = factor_input();
        if (age >= kRefactorFrames || contacts_changed(input.diagonal)) {
            start_factor(std::move(input));
            m_factor_frame = m_frame;
        }
    }
    ++m_frame;
}

int FleshSolver::descend(int least, int most, float still_m) {
    double energy = m_energy.evaluate(m_positions, m_gradient);
    const std::size_t n = m_positions.size();
    m_trial.resize(n);
    m_step.assign(n, Eigen::Vector4f::Zero());
    int taken = 0;
    for (int k = 0; k < most; ++k) {
        for (auto& g : m_gradient) g = -g;
        m_preconditioner.solve(m_gradient, m_direction);
        float momentum = std::min(0.7F, static_cast<float>(k) / static_cast<float>(k + 3));
        float farthest_sq = 0;
        for (std::size_t i = 0; i < n; ++i)
            farthest_sq = std::max(farthest_sq, (m_direction[i] + momentum * m_step[i]).squaredNorm());
        float length = std::min(1.0F, kFarthestStep_m / std::sqrt(farthest_sq + 1e-30F));
        const auto energy_after = [&] {
            for (std::size_t i = 0; i < n; ++i)
                m_trial[i] = m_positions[i] + length * (m_direction[i] + momentum * m_step[i]);
            return m_energy.evaluate(m_trial, m_gradient);
        };
        double next = energy_after();
        if (!(next <= energy + rounding_of(energy)) && momentum > 0) {
            momentum = 0;
            next = energy_after();
        }
        for (int h = 0; h < kMostHalvings && !(next <= energy + rounding_of(energy)); ++h) {
            length /= 2;
            next = energy_after();
        }
        if (!(next <= energy + rounding_of(energy))) break;
        for (std::size_t i = 0; i < n; ++i) m_step[i] = length * (m_direction[i] + momentum * m_step[i]);
        std::swap(m_positions, m_trial);
        energy = next;
        ++taken;
        if (taken >= least && length * std::sqrt(farthest_sq) < still_m) break;
    }
    m_last_energy = energy;
    return taken;
}

}  // namespace windfall::decay
