#pragma once
// Drying by the hour: theta as a field, from water that diffuses in the flesh and leaves through the skin.
#include <map>
#include <string>

#include "drying/drying_course.h"
#include "drying/flesh_diffusion.h"
#include "drying/parameters.h"
#include "drying/skin_exposure.h"
#include "water/climate.h"
#include "water/ledger.h"

namespace windfall::drying {

/// The path's parameter is hours. The flesh of an element shrinks by the volume of the water that has left
/// it, theta^3 = solids + water over the fresh volume, until drying.shrinkage; what leaves then leaves pores.
class MoistureCourse : public DryingCourse {
  public:
    /// `mesh`: the fresh body. Throws InputError where the parameters ask for what cannot be.
    MoistureCourse(const geometry::LayeredMesh& mesh, const DryingParameters& parameters,
                   SkinExposure exposure);

    CourseState start() const override;
    CourseIncrement increment(const CourseState& from, double target, double largest_change,
                              const BodyNodes& body) const override;
    DryingField field(const CourseState& state) const override;
    std::map<std::string, double> measures(const CourseState& state) const override;
    std::vector<double> skin_moisture(const CourseState& state) const override;
    std::vector<double> skin_dryness(const CourseState& state) const override;

    /// Of each cell of the flesh, in the order of FleshCells.
    std::vector<double> shrinkages(const CourseState& state) const;
    /// Water of the flesh of the whole fruit. What is lost was counted at the skin, what is left in the
    /// cells.
    water::WaterLedger ledger(const CourseState& state) const;

    const FleshCells& cells() const { return m_cells; }
    /// What evaporates from each quad in r_1^3 a second, `hour` hours after the start, from a skin of these
    /// areas (r_1^2).
    SkinEvaporation evaporation_at(double hour, const std::vector<double>& areas) const;

  private:
    struct Step;
    DryingField field_of(std::vector<double> shrinkages) const;
    double kg_of(double volume) const;

    RecipeDrying m_drying;
    MoistureParameters m_moisture;
    double m_largest_shrinkage, m_size_m;
    int m_flesh_layers;
    FleshCells m_cells;
    SkinExposure m_exposure;
    water::Climate m_climate;
    double m_fresh_water;  ///< content of a fresh cell
    double m_solutes;
};

}  // namespace windfall::drying
