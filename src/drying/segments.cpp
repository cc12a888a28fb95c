#include "drying/segments.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace windfall::drying {

namespace {

/// Length of [low, high] that lies in walls, walls being the intervals of `width` about the integers.
double length_in_walls(double low, double high, double width) {
    const auto below = [width](double x) {
        const double whole = std::floor(x + 0.5);
        return whole * width + std::clamp(x - whole + width / 2, 0.0, width);
    };
    return below(high) - below(low);
}

}  // namespace

std::vector<double> wall_parts(const geometry::LayeredMesh& mesh, const SegmentParameters& segments) {
    std::vector<double> result;
    if (segments.count == 0) return result;
    const double segment = 2 * std::numbers::pi / static_cast<double>(segments.count);
    for (const auto& quad : mesh.brick.quads) {
        // Longitudes relative to the first corner's, so that none of them jumps by a turn.
        double first = 0;
        double low = 0;
        double high = 0;
        double turn = 0;
        double last = 0;
        for (std::size_t c = 0; c <= 4; ++c) {
            const geometry::Vec3& d = mesh.directions[static_cast<std::size_t>(quad[c % 4])];
            const double longitude = std::atan2(d.z(), d.x());
            if (c == 0) {
                first = longitude;
            } else {
                turn += std::remainder(longitude - last, 2 * std::numbers::pi);
                low = std::min(low, turn);
                high = std::max(high, turn);
            }
            last = longitude;
        }
        // On the way around a quad that holds the axis the longitude makes a whole turn.
        const bool on_axis = high - low > std::numbers::pi / 2;
        const double from = (first + low) / segment, to = (first + high) / segment;
        result.push_back(on_axis ? segments.wall_width
                                 : length_in_walls(from, to, segments.wall_width) / (to - from));
    }
    return result;
}

std::vector<double> wall_stiffening(const std::vector<double>& walls, const SegmentParameters& segments) {
    std::vector<double> result;
    for (const double part : walls) result.push_back(std::lerp(1.0, segments.wall_stiffness, part));
    return result;
}

DryingField with_walls(DryingField drying, const std::vector<double>& walls,
                       const SegmentParameters& segments, int flesh_layers) {
    if (walls.empty()) return drying;
    return [drying = std::move(drying), &walls, kept = 1 - segments.wall_shrinkage, flesh_layers](
               std::size_t quad, int layer) -> Eigen::Matrix3d {
        const Eigen::Matrix3d own = drying(quad, layer);
        if (layer >= flesh_layers) return own;
        return own + walls[quad] * kept * (Eigen::Matrix3d::Identity() - own);
    };
}

}  // namespace windfall::drying
