#include "export/curves_to_export.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace windfall::export_ {

std::vector<CurvesToExport> curves_at(const take::Frame& frame, double metres) {
    const auto scale = static_cast<float>(metres);
    const bool one_mesh = std::all_of(frame.curves.begin(), frame.curves.end(), [&](const auto& curves) {
        return curves.mesh == frame.curves.front().mesh;
    });
    std::vector<CurvesToExport> all;
    for (const auto& curves : frame.curves) {
        CurvesToExport result;
        result.name = one_mesh ? curves.name : curves.mesh + "_" + curves.name;
        result.points_per_strand = curves.points_per_strand;
        result.colours = curves.colours;
        for (const auto& point : curves.points) {
            if (!point.allFinite())
                throw InputError(fmt::format(
                    "frame {} has hair that is nowhere (not a number); make the take again", frame.index));
            result.points.emplace_back(scale * point);
        }
        for (const float radius : curves.radii) result.radii.push_back(scale * radius);
        all.push_back(std::move(result));
    }
    return all;
}

std::vector<std::array<std::uint32_t, 2>> segments_of(const CurvesToExport& curves) {
    std::vector<std::array<std::uint32_t, 2>> segments;
    for (std::size_t point = 0; point + 1 < curves.points.size(); ++point)
        if (curves.strand_of(point) == curves.strand_of(point + 1))
            segments.push_back({static_cast<std::uint32_t>(point), static_cast<std::uint32_t>(point + 1)});
    return segments;
}

}  // namespace windfall::export_
