// Follows a branch from section to section.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"
#include "fracture/tree_branch.h"
#include "fracture/tree_text.h"

namespace windfall::fracture {
namespace {

using geometry::Vec3;

/// Steps of a fifth of the radius resolve the curve of a branch whose sections do not meet.
constexpr double kStepInRadii = 0.2;
/// How much the section may grow or shrink from the picked place on: the flare at a fork brings it to twice
/// and more.
constexpr double kMostGrowth = 1.9, kMostShrink = 0.4;
/// ... and from one step to the next.
constexpr double kMostGrowthInStep = 1.3;
/// How much longer than round the section may become, against that at the picked place.
constexpr double kMostStretch = 1.5;

struct Walk {
    std::vector<Vec3> centres;  // behind the first one, which is the branch's
    std::string obstacle;       // why it ends early; empty when it did not
    bool is_open = false;
};

class Follower {
  public:
    Follower(const TreeSurface& surface, SectionTracer& tracer, const TreeBranch& branch, double reach)
        : m_tracer(tracer),
          m_branch(branch),
          m_near(triangles_near(surface, branch.component, branch.centre, reach + 4 * branch.radius)),
          m_steps(static_cast<std::size_t>(std::ceil(reach / step()))) {
        const std::optional<Section> first = loop_at(branch.centre, branch.axis);
        if (first) m_first = *first;
    }

    double step() const { return kStepInRadii * m_branch.radius; }

    Walk walk(const Vec3& axis) {
        Walk walk;
        Vec3 centre = m_branch.centre, along = axis;
        double area = m_first.area;
        for (std::size_t i = 0; i < m_steps; ++i) {
            const Vec3 next = centre + step() * along;
            const std::optional<Section> section = loop_at(next, along);
            if (!section) {
                walk.is_open = m_met_open;
                walk.obstacle = m_met_open ? fmt::format("is not closed at {}", text_of(m_open_at)) : "ends";
                return walk;
            }
            walk.obstacle = obstacle_at(*section, area, next);
            if (!walk.obstacle.empty()) return walk;
            area = section->area;
            along = (0.5 * along + 0.5 * (section->centroid - centre).normalized()).normalized();
            // One step along the axis, in the direction of the new centroid.
            centre += step() * (section->centroid - centre).normalized();
            walk.centres.push_back(centre);
        }
        return walk;
    }

  private:
    std::optional<Section> loop_at(const Vec3& origin, const Vec3& normal) {
        m_met_open = false;
        std::optional<Section> best;
        double least = std::numeric_limits<double>::infinity();
        for (const Section& section : m_tracer.cut(m_near, origin, normal)) {
            const double distance = section.distance(origin);
            const bool is_around = section.closed && section.encloses(origin);
            if (is_around) return section;
            if (distance >= least || distance > 1.5 * m_branch.radius) continue;
            least = distance;
            m_met_open = !section.closed;
            if (m_met_open) m_open_at = section.loose_end();
        }
        return best;
    }

    /// Empty when the section goes on like those before it.
    std::string obstacle_at(const Section& section, double last_area, const Vec3& expected) const {
        const double growth = section.area / m_first.area, in_step = section.area / last_area;
        if (growth < kMostShrink || in_step * kMostGrowthInStep < 1) return "ends or divides";
        const auto stretch = [](const Section& s) { return s.outer_radius(s.centroid) / s.radius(); };
        const bool goes_on = growth < kMostGrowth && in_step < kMostGrowthInStep &&
                             (section.centroid - expected).norm() < 0.5 * m_branch.radius &&
                             stretch(section) < kMostStretch * stretch(m_first);
        return goes_on ? "" : "forks or has a side branch";
    }

    SectionTracer& m_tracer;
    const TreeBranch& m_branch;
    std::vector<std::int32_t> m_near;
    std::size_t m_steps;
    Section m_first;
    bool m_met_open = false;
    Vec3 m_open_at = Vec3::Zero();
};

void smooth(std::vector<Vec3>& centres) {
    for (int round = 0; round < 2; ++round) {
        const std::vector<Vec3> old = centres;
        for (std::size_t i = 1; i + 1 < centres.size(); ++i)
            centres[i] = 0.25 * old[i - 1] + 0.5 * old[i] + 0.25 * old[i + 1];
    }
}

[[noreturn]] void refuse(const TreeSurface& surface, const TreeBranch& branch, const Walk& stopped,
                         const Walk& other, const Vec3& away, double step, double reach) {
    const double has = static_cast<double>(stopped.centres.size()) * step;
    const double there = static_cast<double>(other.centres.size()) * step;
    std::string remedy = "lower the break (its heights and amplitudes), or pick a longer stretch of branch";
    if (stopped.is_open)
        remedy = "close the mesh there and export it again";
    else if (other.obstacle.empty() || there > 2 * reach - has)
        remedy = fmt::format(
            "pick a point {:.3g} farther from there, near --at {}", reach - has,
            text_of(nearest_place(surface, branch.point + (reach - has + branch.radius) * away).position));
    throw InputError(fmt::format(
        "the branch {} {:.3g} from the picked point {} (radius {:.3g}), and the break needs {:.3g} "
        "to both sides; {}",
        stopped.obstacle, has, text_of(branch.point), branch.radius, reach, remedy));
}

}  // namespace

BranchAxis follow_branch(const TreeSurface& surface, SectionTracer& tracer, const TreeBranch& branch,
                         double reach, const Vec3& up) {
    Follower follower(surface, tracer, branch, reach);
    const Walk below = follower.walk(-branch.axis);
    const Walk above = follower.walk(branch.axis);
    const double step = follower.step();
    if (!below.obstacle.empty()) refuse(surface, branch, below, above, branch.axis, step, reach);
    if (!above.obstacle.empty()) refuse(surface, branch, above, below, -branch.axis, step, reach);

    std::vector<Vec3> centres(below.centres.rbegin(), below.centres.rend());
    centres.push_back(branch.centre);
    centres.insert(centres.end(), above.centres.begin(), above.centres.end());
    smooth(centres);
    // An upright branch has no upper side.
    Vec3 across = up;
    if (up.cross(branch.axis).norm() < 0.1) across = std::abs(up.x()) > 0.5 ? Vec3::UnitZ() : Vec3::UnitX();
    BranchAxis axis(std::move(centres), below.centres.size(), step, across);
    // Planes of neighbouring sections must not meet inside the branch.
    if (axis.sharpest_turn() * 1.3 * branch.radius > step)
        throw InputError(
            fmt::format("the branch bends too sharply near {} for a break of this length; pick a straighter "
                        "place, or lower the break",
                        text_of(branch.point)));
    return axis;
}

}  // namespace windfall::fracture
