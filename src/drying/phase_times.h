#pragma once
// Where the time goes, for docs and benchmarks; never part of a frame.
#include <chrono>

namespace windfall::drying {

struct PhaseTimes {
    double assembly_s = 0;
    double multigrid_setup_s = 0;
    double linear_solver_s = 0;
    double energy_s = 0;
};

/// Adds the time of its own life to a sum.
class PhaseTimer {
  public:
    explicit PhaseTimer(double& sum_s) : m_sum_s(sum_s), m_start(std::chrono::steady_clock::now()) {}
    ~PhaseTimer() {
        m_sum_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count();
    }
    PhaseTimer(const PhaseTimer&) = delete;
    PhaseTimer& operator=(const PhaseTimer&) = delete;

  private:
    double& m_sum_s;
    std::chrono::steady_clock::time_point m_start;
};

}  // namespace windfall::drying
