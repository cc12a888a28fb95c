#pragma once
// One increment of drying: the minimum of the incremental potential
//   energy(u) + c / (2 dt) |u - u_from|^2_M,
// whose stationarity is equilibrium with the paper's viscous force (eq. 12) where u_from is the displacement
// before, and with one that leaves slow motion alone where it is that and a drift. Minimised by Newton's
// method in a trust region, so that a bifurcation is passed downhill and never along an indefinite tangent.
#include <vector>

#include "core/run_context.h"
#include "drying/conjugate_gradients.h"
#include "drying/elasticity.h"
#include "drying/phase_times.h"
#include "drying/skin_contact.h"

namespace windfall::drying {

struct NewtonSettings {
    double tolerance = 0.1;  ///< accepted norm of the out-of-balance force over `reference_force`
    double reference_force = 1;
    double radius = 0;  ///< first trust radius: root mean square displacement, in r_1
    int max_iterations = 12;
    int max_rejections = 2;   ///< steps thrown away before the increment is given up
    int max_corrections = 3;  ///< second-order corrections of a step with the same matrix
    int max_linear_iterations = 200;
};

/// The viscous term of the potential.
struct Damping {
    const AlignedArray<double>* from = nullptr;  ///< displacement that the viscous force pulls to
    double factor = 0;                           ///< c / dt
};

struct NewtonResult {
    bool converged = false;
    int newton_steps = 0;
    int linear_iterations = 0;
    int rejections = 0;
    double potential = 0;
    double elastic_energy = 0;
    ContactEnergy contact;
    double residual = 0;  ///< norm of the out-of-balance force over the reference force
    double smallest_volume_ratio = 0;
    bool indefinite = false;         ///< negative curvature or an indefinite tangent was met
    std::vector<double> potentials;  ///< at the start and after each accepted step: never rises
};

class NewtonSolver {
  public:
    /// With `contact` not null the potential holds its energy, and no step passes through the skin. Keeps
    /// both.
    explicit NewtonSolver(Elasticity& elasticity, SkinContact* contact = nullptr);

    /// Minimises from `displacement`, which holds the minimum when the result says converged and is
    /// unspecified otherwise. Throws Cancelled.
    NewtonResult minimize(AlignedArray<double>& displacement, const Damping& damping,
                          const NewtonSettings& settings, const RunContext& context);

    /// Potential at a displacement; infinite where elements are inverted.
    double potential(const AlignedArray<double>& displacement, const Damping& damping);

    const PhaseTimes& times() const { return m_times; }
    ConjugateGradients& linear_solver() { return m_linear; }

  private:
    struct State {
        AlignedArray<double> displacement, force;
        double potential = 0;
        double elastic_energy = 0;
        ContactEnergy contact;
        double smallest_volume_ratio = 0;
        double force_norm = 0;
        bool valid() const;
        explicit State(std::size_t size) : displacement(size), force(size) {}
    };
    /// With `from` not null the state is first drawn back along its way from there, so far that nothing
    /// passes through the skin.
    void evaluate(State& state, const Damping& damping, const State* from = nullptr);
    double damping_energy(const AlignedArray<double>& displacement, const Damping& damping,
                          AlignedArray<double>* force) const;
    LinearResult linear_step(const State& at, double tolerance, int max_iterations, double radius,
                             double reference_force, const RunContext& context);
    LinearResult newton_step(const State& at, const Damping& damping, double tolerance, double radius,
                             const NewtonSettings& settings, const RunContext& context, bool& indefinite);
    void take_step(const State& from, State& to, double reference_force) const;
    bool shorten(State& trial, const State& start, const Damping& damping);
    int correct(State& trial, const State& start, double step_length, const Damping& damping,
                const NewtonSettings& settings, const RunContext& context, int& linear_iterations);

    Elasticity& m_elasticity;
    SkinContact* m_contact;
    ConjugateGradients m_linear;
    PhaseTimes m_times;
    State m_current, m_trial, m_corrected;
    AlignedArray<float> m_right, m_step;  ///< both over the reference force
};

}  // namespace windfall::drying
