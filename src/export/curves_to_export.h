#pragma once
// Hair as every format writes it: strands of points, in metres, Y up.
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "take/frame.h"

namespace windfall::export_ {

struct CurvesToExport {
    std::string name;  ///< "mold"; with the mesh before it where there are several: "skin_0_mold"
    int points_per_strand = 2;
    std::vector<Eigen::Vector3f> points;   ///< of each strand, from the root on; metres
    std::vector<float> radii;              ///< one a strand, metres
    std::vector<Eigen::Vector3f> colours;  ///< one a strand, linear

    std::size_t strand_of(std::size_t point) const {
        return point / static_cast<std::size_t>(points_per_strand);
    }
};

/// All curves of a frame. `metres`: of one unit of the take's lengths. InputError when a point is no number.
std::vector<CurvesToExport> curves_at(const take::Frame& frame, double metres);

/// Pairs of neighbouring points along all strands.
std::vector<std::array<std::uint32_t, 2>> segments_of(const CurvesToExport& curves);

}  // namespace windfall::export_
