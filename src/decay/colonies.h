#pragma once
// Colonies and how they spread: Kider, Raja, Badler 2011, section 4, step 1, with the chances a day instead
// of a frame.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "decay/growth.h"
#include "decay/starting_points.h"

namespace windfall::decay {

struct ColonySettings {
    double propagation = 3;  ///< 0..9: a colony sends a seed with probability 1 / (10 - propagation) a day
    double reach_m = 0.012;  ///< how far seeds fall from the middle of their colony
    double seed_radius_m = 0.0014;  ///< of a new colony
    double seed_density = 0.5;      ///< at its middle, 0..1
    double crowded_density = 0.05;  ///< no new colony where the organism's own density is above this ...
    double poor_nutrient = 0.3;     ///< ... or the nutrient below this
    std::size_t most = 500;         ///< colonies of all organisms together
};

/// A spot where an organism began.
struct Colony {
    std::size_t organism = 0;
    std::size_t texel = 0;
    double time_h = 0;
};

/// The colonies of one skin. All choices are keyed by seed, day and colony, never by order of work.
class Colonies {
  public:
    /// Throws InputError for a propagation outside 0..9 or a reach that is not positive.
    Colonies(const ColonySettings& settings, std::uint64_t seed);

    /// Plants a starting point. A fungus whose gate is still closed there waits and is planted by `spread`
    /// once it has opened.
    void start(Growth& growth, const StartingPoint& point);

    /// Lets colonies seed new ones for every whole day that has passed at growth.time_h() and was not yet
    /// dealt with, soft rot first; plants what has been waiting.
    void spread(Growth& growth);

    const std::vector<Colony>& list() const { return m_colonies; }
    std::size_t waiting_count() const { return m_waiting.size(); }

    std::vector<std::byte> save() const;
    /// Throws InputError when the bytes are not of Colonies.
    void restore(std::span<const std::byte> state);

  private:
    struct Waiting {
        std::size_t organism = 0, texel = 0;
        double radius_m = 0, density = 0;
    };
    void plant_waiting(Growth& growth);
    void spread_day(Growth& growth, std::size_t organism);

    ColonySettings m_settings;
    std::uint64_t m_seed;
    std::uint64_t m_day = 0;
    std::vector<Colony> m_colonies;
    std::vector<Waiting> m_waiting;
};

}  // namespace windfall::decay
