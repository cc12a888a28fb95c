#include "drying/drying_course.h"

#include <algorithm>

namespace windfall::drying {

CourseIncrement GivenShrinkage::increment(const CourseState& from, double target, double largest_change,
                                          const std::vector<geometry::Vec3>& /*nodes*/) const {
    CourseIncrement result;
    result.change = std::min(largest_change, target - from.parameter);
    result.cut_at_target = result.change < largest_change;
    double end = from.parameter + result.change;
    result.field = m_drying.at(end);
    if (target - end < kSameParameter) end = target;
    result.to = {end, end, {}};
    return result;
}

}  // namespace windfall::drying
