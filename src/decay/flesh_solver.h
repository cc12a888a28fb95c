#pragma once
// Brings the flesh towards the least energy: preconditioned descent with momentum, in which no step is taken
// that would raise the energy.
#include <Eigen/Core>
#include <cstdint>
#include <future>
#include <vector>

#include "decay/flesh.h"
#include "decay/flesh_preconditioner.h"

namespace windfall::decay {

class FleshSolver {
  public:
    using Positions = std::vector<Eigen::Vector4f>;

    FleshSolver(const FleshMesh& mesh, double density_kg_m3);
    FleshSolver(const FleshSolver&) = delete;
    FleshSolver& operator=(const FleshSolver&) = delete;
    ~FleshSolver();

    FleshEnergy<float>& energy() { return m_energy; }
    const FleshEnergy<float>& energy() const { return m_energy; }
    const Positions& positions() const { return m_positions; }
    /// Moves all nodes by the same vector (m).
    void translate(const Eigen::Vector3f& by_m);

    /// Starts a frame: damping and friction hold what is now. The preconditioner is made anew every
    /// `kRefactorFrames` frames, and when the contacts are no longer those that it was made for; beside the
    /// frames, and it is always taken up the same number of frames later: results do not depend on how long
    /// it took.
    void begin_frame();

    /// Steps of descent: `least`, and on to `most` while a step still moves some node by more than `still_m`.
    /// Returns how many were taken. Material, planes and weight must be set.
    int descend(int least, int most, float still_m);

    double last_energy_j() const { return m_last_energy; }

    static constexpr int kRefactorFrames = 25;
    static constexpr int kRefactorDelay = 6;

    /// Everything that the next frames depend on, in one order for both ways: `archive(value)` is called for
    /// numbers and for arrays of numbers.
    template <class Archive>
    void serialise(Archive& archive);

  private:
    /// What a factor is made from; kept, so that a restored solver can make the same one.
    struct FactorInput {
        std::vector<float> weights, diagonal;
    };
    FactorInput factor_input() const;
    void start_factor(FactorInput input);
    void take_factor();
    void forget_factors();
    bool contacts_changed(const std::vector<float>& diagonal) const;

    FleshEnergy<float> m_energy;
    FleshPreconditioner m_preconditioner, m_next_preconditioner;
    FactorInput m_input, m_next_input;  ///< of the two above
    std::future<void> m_factoring;
    std::int64_t m_frame = 0;
    std::int64_t m_factor_frame = 0;  ///< in which the latest factor was started
    Positions m_positions;
    double m_last_energy = 0;
    Positions m_gradient, m_direction, m_step, m_trial;
};

template <class Archive>
void FleshSolver::serialise(Archive& archive) {
    if constexpr (Archive::kReading) forget_factors();
    archive(m_frame);
    archive(m_factor_frame);
    archive(m_positions);
    archive(m_energy.quaternions());
    archive(m_input.weights);
    archive(m_input.diagonal);
    archive(m_next_input.weights);
    archive(m_next_input.diagonal);
    if constexpr (Archive::kReading) {
        if (!m_input.weights.empty()) m_preconditioner.factorise(m_input.weights, m_input.diagonal);
        if (!m_next_input.weights.empty()) start_factor(m_next_input);
    }
}

}  // namespace windfall::decay
