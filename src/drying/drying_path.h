#pragma once
// The equilibria of a body as its shrinkage grows, or falls again: increments with predictor, trust region
// and step control.
#include <functional>
#include <memory>
#include <vector>

#include "core/run_context.h"
#include "drying/drying_course.h"
#include "drying/fibres.h"
#include "drying/newton.h"
#include "drying/plastic_set.h"
#include "drying/segments.h"
#include "geometry/smooth_surface.h"

namespace windfall::drying {

/// No increment converges any more; the text says at which shrinkage and what to try.
class LostEquilibrium : public RunError {
  public:
    using RunError::RunError;
};

/// What is kept of every accepted increment.
struct StepRecord {
    double parameter = 0;       ///< of the course: shrinkage, or hours
    double shrinkage = 0;       ///< of the flesh as a whole
    double depth_rms = 0;       ///< root mean square of the skin's depth, in r_1
    double elastic_energy = 0;  ///< in C0 of the flesh times r_1^3
    double viscous_work = 0;    ///< done against the viscous force since the start
    double smallest_volume_ratio = 1;
    int newton_steps = 0;  ///< with those of failed attempts before
    int linear_iterations = 0;
    int failures = 0;  ///< attempts that were given up before this one
    int contacts = 0;  ///< pairs of parts of the skin closer than the contact's gap
};

/// Everything that the way ahead depends on; a checkpoint is this and nothing else.
struct PathState {
    CourseState course;
    double next_step = 0;            ///< largest change of an element's shrinkage in the next increment
    std::vector<double> past_steps;  ///< such changes in the last increments, latest first; at most 2
    std::vector<AlignedArray<double>> displacements;  ///< now, and after the increments before; at most 3
    PlasticSet set;                                   ///< empty before the first flow
    std::vector<StepRecord> history;
    StepRecord pending;  ///< attempts since the last accepted increment: counts only
};

class DryingPath {
  public:
    /// `mesh` is the fresh body, imperfection included. Dries it by `course`; without one the path's
    /// parameter is the shrinkage of all flesh.
    DryingPath(geometry::LayeredMesh mesh, const DryingParameters& parameters,
               std::unique_ptr<DryingCourse> course);
    DryingPath(geometry::LayeredMesh mesh, const DryingParameters& parameters);

    /// Goes on until the course's parameter is `target` exactly. Calls `on_step` after each increment. Throws
    /// RunError where equilibrium is lost: the state is then that of the last equilibrium. Throws Cancelled
    /// likewise.
    void advance(double target, const RunContext& context, const std::function<void()>& on_step = {});

    const PathState& state() const { return m_state; }
    void set_state(PathState state) { m_state = std::move(state); }

    /// Where the course is: shrinkage, or hours.
    double parameter() const { return m_state.course.parameter; }
    /// Of the flesh as a whole.
    double shrinkage() const { return m_state.course.shrinkage; }
    /// Fd of every element now.
    DryingField drying_field() const { return walled(m_course->field(m_state.course)); }
    /// Fd of every element where all flesh has one shrinkage.
    DryingField drying_field_at(double shrinkage) const { return walled(m_drying.at(shrinkage)); }
    const DryingCourse& course() const { return *m_course; }
    /// Shrinkage at which the skin's depth passed a tenth of its thickness; negative before that.
    double onset() const;

    const geometry::LayeredMesh& mesh() const { return m_mesh; }
    Elasticity& elasticity() { return *m_elasticity; }
    const Elasticity& elasticity() const { return *m_elasticity; }
    NewtonSolver& newton() { return *m_newton; }
    /// Null where the skin may pass through itself.
    SkinContact* contact() { return m_contact.get(); }
    /// The material: moduli by layer, fibres, and below what walls make of the moduli.
    const LayerModuli& moduli() const { return m_moduli; }
    const Fibres& fibres() const { return m_fibres; }
    /// Factors of the flesh's moduli by quad of the brick; empty: 1 everywhere.
    std::vector<double> flesh_stiffening() const { return wall_stiffening(m_walls, m_parameters.segments); }
    /// The stretch of the stress-free state, element by element, now: of drying and of plastic set. Valid
    /// while the path stands still.
    DryingField stress_free() const { return with_set(drying_field(), m_state.set, m_mesh.layers); }
    double reference_force() const { return m_reference_force; }

    /// The displacement now, carried on by the slow part of the last increment's motion for an increment of
    /// `step`: the viscous force pulls to it, so that what the whole fruit does is not damped. Without a last
    /// increment, or where wrinkles are as long as the fruit, the displacement itself.
    AlignedArray<double> drift(double step) const;

    /// Nodes now: [column * layers + k], in the brick's order.
    std::vector<geometry::Vec3> positions() const;
    /// The outermost of them: the skin's vertices, in the brick's order.
    std::vector<geometry::Vec3> skin_positions() const;
    /// Depth of the skin's vertices below the smooth surface, in the brick's order.
    std::vector<double> skin_depth() const;

  private:
    /// Adds the walls of segments to a field of the course.
    DryingField walled(DryingField field) const {
        return with_walls(std::move(field), m_walls, m_parameters.segments, m_mesh.flesh_layers);
    }
    bool attempt(double target, const RunContext& context);
    void take(CourseIncrement increment, AlignedArray<double> displacement, const NewtonResult& result);
    void set_step_after(const CourseIncrement& increment, const NewtonResult& result);
    AlignedArray<double> predict(double step) const;
    /// Whether the flesh swells where it last shrank, or the other way round.
    bool goes_back(const CourseIncrement& increment) const;
    double root_mean_square_depth() const;

    geometry::LayeredMesh m_mesh;
    DryingParameters m_parameters;
    RecipeDrying m_drying;
    std::unique_ptr<DryingCourse> m_course;
    std::vector<double> m_walls;  ///< see segments.h
    LayerModuli m_moduli;
    Fibres m_fibres;
    std::unique_ptr<Multigrid> m_multigrid;
    std::unique_ptr<Elasticity> m_elasticity;
    std::unique_ptr<SkinContact> m_contact;
    std::unique_ptr<NewtonSolver> m_newton;
    std::vector<geometry::Vec3> m_skin_rest;
    std::vector<double> m_skin_areas;
    std::unique_ptr<geometry::SlowField> m_slow;
    double m_reference_force = 1;
    PathState m_state;
};

}  // namespace windfall::drying
