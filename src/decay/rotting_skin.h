#pragma once
// What lives on the skin of one fruit and the water that leaves through it.
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "decay/colonies.h"
#include "decay/growth.h"
#include "decay/parameters.h"
#include "decay/skin_form.h"
#include "take/frame.h"
#include "water/climate.h"
#include "water/ledger.h"

namespace windfall::decay {

/// Where rot may begin on one fruit, as directions of its surface function.
struct SkinStarts {
    std::vector<geometry::Vec3> contacts;  ///< wet, and richer in nutrient
    std::vector<geometry::Vec3> wounds;
};

/// Growth, colonies and water of one fruit.
class RottingSkin {
  public:
    /// `surface` gives the fresh fruit's points; `relative_mass` is its mass over that of the parameters.
    RottingSkin(const DecayParameters& parameters, const geometry::CubeAtlas& atlas,
                const SurfaceFunction& surface, const SkinStarts& starts, double relative_mass,
                std::uint64_t seed);

    /// Lets all that lives on it grow for some hours.
    void grow(double hours, const water::Air& air);
    /// Lets water leave through `area_m2` of skin.
    void lose_water(double hours, double area_m2, const water::Air& air);
    /// Rot that comes over from a neighbour that touches it there.
    void infect(const geometry::Vec3& direction);
    /// Whether soft rot is established in a direction.
    bool is_rotten(const geometry::Vec3& direction) const;

    /// Share of thoroughly rotten skin, 0..1, in each direction.
    std::vector<float> rot_at(std::span<const geometry::Vec3> directions) const;

    /// The maps of growth, for the mesh of that name: nutrient, soft_rot, fungus (fungus_NAME where there are
    /// several) and the active shares of fungi.
    std::vector<take::FrameMap> maps(const std::string& mesh, const SkinForm& form) const;

    /// Numbers of the moment: water, areas, fronts, colonies, conservation.
    std::map<std::string, double> numbers() const;

    const water::WaterLedger& ledger() const { return m_ledger; }
    const Growth& growth() const { return m_growth; }

    std::vector<std::byte> save() const;
    /// Throws InputError for a state of another skin.
    void restore(std::span<const std::byte> state);

  private:
    double water_activity() const;

    const geometry::CubeAtlas& m_atlas;
    Growth m_growth;
    Colonies m_colonies;
    water::WaterLedger m_ledger;
    double m_transpiration, m_rot_leak;
    double m_start_total = 0, m_planted = 0;
};

}  // namespace windfall::decay
