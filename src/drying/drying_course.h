#pragma once
// What dries a body along its path: how much each element has shrunk at each value of the path's parameter.
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "drying/drying_field.h"
#include "geometry/layered_mesh.h"

namespace windfall::drying {

/// How far a course is, and all that its way ahead depends on.
struct CourseState {
    double parameter = 0;        ///< of the path, rising: given shrinkage, or hours
    double shrinkage = 0;        ///< of the flesh as a whole, 1 - theta
    std::vector<double> values;  ///< what else the course keeps, in its own order
};

/// A piece of a course. Nothing of the course changes until `to` is taken for the state.
struct CourseIncrement {
    CourseState to;
    double change = 0;           ///< largest change of an element's shrinkage, >= 0
    bool turns = false;          ///< the way goes back from its end
    bool cut_at_target = false;  ///< ended by the target, before an element had changed as much as it may
    DryingField field;           ///< Fd at the end; valid as long as the course
};

using BodyNodes = std::function<std::vector<geometry::Vec3>()>;

class DryingCourse {
  public:
    virtual ~DryingCourse() = default;

    virtual CourseState start() const = 0;
    /// Goes on from `from` until the parameter is `target` or an element's shrinkage has changed by
    /// `largest_change`, whichever comes first. `nodes()`: the body in `from`, as in LayeredMesh.
    virtual CourseIncrement increment(const CourseState& from, double target, double largest_change,
                                      const BodyNodes& nodes) const = 0;
    /// Fd in a state; valid as long as the course.
    virtual DryingField field(const CourseState& state) const = 0;
    /// Numbers of a state for frames, by name.
    virtual std::map<std::string, double> measures(const CourseState& /*state*/) const { return {}; }
    /// Water under each quad of the skin over the fresh flesh's, 0..1; empty: not known.
    virtual std::vector<double> skin_moisture(const CourseState& /*state*/) const { return {}; }
    /// Shrinkage of the flesh under each quad over the largest that it may reach; empty: that of all flesh.
    virtual std::vector<double> skin_dryness(const CourseState& /*state*/) const { return {}; }
};

/// Shrinkage after a way up to `most` and down again.
inline double shrinkage_on_way(double way, double most) { return way <= most ? way : 2 * most - way; }

/// The paper's: one shrinkage for all flesh. The parameter is the way that it has gone, up to `most` and, as
/// the fruit takes up water, down again.
class GivenShrinkage : public DryingCourse {
  public:
    GivenShrinkage(RecipeDrying drying, double most) : m_drying(std::move(drying)), m_most(most) {}

    CourseState start() const override { return {}; }
    CourseIncrement increment(const CourseState& from, double target, double largest_change,
                              const BodyNodes& nodes) const override;
    DryingField field(const CourseState& state) const override { return m_drying.at(state.shrinkage); }

  private:
    RecipeDrying m_drying;
    double m_most;
};

/// Nearer to its target than this a parameter has reached it.
inline constexpr double kSameParameter = 1e-9;

}  // namespace windfall::drying
