#include "decay/rot_front.h"

#include <algorithm>
#include <cmath>

namespace windfall::decay {
namespace {

/// |grad H| from the differences of H and of the positions to the texel on the right and to the one below.
double slope(double right, double below, const geometry::Vec3& e, const geometry::Vec3& f) {
    const double ee = e.squaredNorm(), ef = e.dot(f), ff = f.squaredNorm();
    const double determinant = ee * ff - ef * ef;
    if (determinant <= 0) return 0;
    const double square = (ff * right * right - 2 * ef * right * below + ee * below * below) / determinant;
    return std::sqrt(std::max(0.0, square));
}

}  // namespace

Front front_of(const geometry::CubeAtlas& atlas, const Growth& growth, std::size_t organism, double low,
               double high) {
    const auto active = growth.active(organism), inactive = growth.inactive(organism);
    const auto areas = growth.areas_m2();
    const auto positions = growth.positions_m();
    const auto side = static_cast<std::size_t>(atlas.side());
    const auto height = [&](std::size_t i) {
        return std::clamp((static_cast<double>(active[i]) + inactive[i] - low) / (high - low), 0.0, 1.0);
    };
    Front front;
    for (const geometry::CubeAtlas::Run& run : atlas.runs())
        for (std::size_t i = run.begin; i < run.end; ++i) {
            const double here = height(i);
            front.area_m2 += here * areas[i];
            // The last texels of a chart have the difference of those before them.
            const std::size_t right = i + 1 < run.end ? i + 1 : i - 1;
            const std::size_t below =
                i + side < atlas.texel_count() && atlas.chart_of(i + side) == run.chart ? i + side : i - side;
            const double to_right = height(right) - here, to_below = height(below) - here;
            if (to_right == 0 && to_below == 0) continue;
            front.length_m += areas[i] * slope(to_right, to_below, positions[right] - positions[i],
                                               positions[below] - positions[i]);
        }
    return front;
}

}  // namespace windfall::decay
