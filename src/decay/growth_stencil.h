#pragma once
// The Laplacian of a closed surface on the texels of its atlas.
#include <cstdint>
#include <span>
#include <vector>

#include "decay/growth_field.h"
#include "geometry/cube_atlas.h"

namespace windfall::decay {

/// Texel centres triangulated: the Delaunay diagonal in every quad of a chart, charts zipped along their
/// seams, one triangle at every corner of the cube. Links carry cotangent weights (clamped at 0), texels
/// their Voronoi areas, so that sum over links of weight (u_j - u_i) / area_i is the Laplacian (M. Meyer, M.
/// Desbrun, P. Schroeder, A. Barr, Discrete differential-geometry operators for triangulated 2-manifolds,
/// 2003). note: the five-point stencil with face length over distance is off by 9-15 % at seams and corners.
struct SurfaceStencil {
    int side = 0;
    /// Weight of the link from a texel to its neighbour within the chart: x + 1; y + 1; both; y + 1 and x
    /// - 1.
    TexelField east, south, south_east, south_west;
    TexelField area_m2, inverse_area;  ///< 0 in the gutters

    /// Links over seams, each from both its ends: those of texel `seam_texels[k]` are
    /// [seam_begin[k], seam_begin[k + 1]); texels rise.
    std::vector<std::uint32_t> seam_texels, seam_begin;
    std::vector<std::uint32_t> seam_neighbour;
    std::vector<float> seam_weight;
};

/// Throws InputError where the surface has no area or a coordinate is not finite.
SurfaceStencil make_stencil(const geometry::CubeAtlas& atlas,
                            std::span<const geometry::Vec3> texel_positions_m);

/// Sum of link weights over area, per texel: the larger half of the largest eigenvalue's bound, in 1/m2.
std::vector<float> link_sums(const SurfaceStencil& stencil);

}  // namespace windfall::decay
