#include "drying/drying_course.h"

#include <algorithm>

namespace windfall::drying {

CourseIncrement GivenShrinkage::increment(const CourseState& from, double target, double largest_change,
                                          const BodyNodes& /*nodes*/) const {
    CourseIncrement result;
    // No increment goes beyond the turn.
    if (from.parameter < m_most - kSameParameter) target = std::min(target, m_most);
    result.change = std::min(largest_change, target - from.parameter);
    result.cut_at_target = result.change < largest_change;
    double end = from.parameter + result.change;
    result.field = m_drying.at(shrinkage_on_way(end, m_most));
    if (target - end < kSameParameter) end = target;
    result.turns = end == m_most;
    result.to = {end, shrinkage_on_way(end, m_most), {}};
    return result;
}

}  // namespace windfall::drying
