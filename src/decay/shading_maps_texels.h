#pragma once
// Where the texels of a map lie on a mesh.
#include <Eigen/Core>
#include <vector>

#include "take/frame.h"

namespace windfall::decay {

/// For every texel of a map laid out by a mesh's texture coordinates, row by row from the top: its place on
/// the fresh skin, in metres. Texels beside a chart take the place of the nearest one in it, `kMargin` texels
/// far, as filters look there; those farther off are not `covered`.
struct ShadingTexels {
    int width = 0, height = 0;
    std::vector<Eigen::Vector3f> places_m;
    std::vector<std::uint8_t> covered;
    /// Texels a metre of skin along u and along v; 0 where not covered.
    std::vector<float> across_per_m, up_per_m;
    Eigen::Vector3f centre_m = Eigen::Vector3f::Zero();  ///< of the fresh mesh
    float radius_m = 1;                                  ///< of the sphere about it

    static constexpr int kMargin = 3;

    /// InputError when the mesh has no texture coordinates or the size is none.
    ShadingTexels(const take::TakeMesh& mesh, double unit_length_m, int map_width, int map_height);
};

}  // namespace windfall::decay
