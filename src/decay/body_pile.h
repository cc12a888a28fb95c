#pragma once
// Bodies that touch: fruit by fruit in turn, each frame, every one sees the ground and its neighbours as
// planes.
#include <span>
#include <vector>

#include "core/run_context.h"
#include "decay/body.h"
#include "decay/body_neighbours.h"

namespace windfall::decay {

/// Two bodies that touch, by their skin vertices within the gap that was asked for.
struct ContactPatch {
    int body = 0;
    int other = -1;                      ///< another body, or -1: the ground
    std::vector<std::int32_t> vertices;  ///< of `body`
};

class BodyPile {
  public:
    /// The bodies stand where their surfaces put them (see `posed`).
    BodyPile(std::vector<Body> bodies, Ground ground);

    /// Lets the bodies come to rest against the ground and each other.
    void settle(const RunContext& run);

    /// One frame; a load per body.
    void advance(std::span<const BodyLoad> loads);

    std::vector<Body>& bodies() { return m_bodies; }
    const std::vector<Body>& bodies() const { return m_bodies; }

    /// Every pair that touches, both ways round.
    std::vector<ContactPatch> patches(double gap_m = 1.5e-3) const;

    /// Deepest that a skin vertex of one body lies inside another (m); 0 when none does.
    double deepest_overlap_m() const;

  private:
    void look_around(std::size_t body);
    void look_at_all();
    void set_damping(double per_s2);
    NearSurface surface_of(std::size_t body) const;

    std::vector<Body> m_bodies;
    std::vector<NearSurface> m_surfaces;  ///< of the bodies' flesh, as they are now
    Ground m_ground;
};

}  // namespace windfall::decay
