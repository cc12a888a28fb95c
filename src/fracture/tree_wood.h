#pragma once
// The broken surface of a free branch, fitted into a branch of a tree.
#include <vector>

#include "fracture/branch_mesh.h"
#include "fracture/tree_branch.h"
#include "fracture/tree_rays.h"

namespace windfall::fracture {

/// Where the unit cylinder's points lie in a tree's branch: (r, angle, z) goes to the point r rho from the
/// axis at height unit (z - middle), with rho the distance of the bark there. One to one, since
/// cross-sections do not meet: what does not overlap in the cylinder does not overlap in the tree.
struct WoodMap {
    const BranchAxis& axis;
    const TreeRays& rays;
    double unit, middle;
    double low, high;  ///< heights that the bark is known between; beyond them its distance stays

    geometry::Vec3 place(const Vector3f& point) const;
    std::vector<geometry::Vec3> places(const std::vector<Vector3f>& points) const;
};

/// Unit normals at the corners of each face, once its vertices lie at `places`.
std::vector<std::array<Vector3f, 4>> corner_normals(const BranchMesh& mesh,
                                                    const std::vector<geometry::Vec3>& places,
                                                    const geometry::Vec3& centre, double unit);

}  // namespace windfall::fracture
