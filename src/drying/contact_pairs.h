#pragma once
// Which parts of a skin could touch: the broad phase of contact.
#include <cstdint>
#include <vector>

#include "drying/contact_gap.h"

namespace windfall::drying {

/// A triangulated skin over its fresh positions.
struct ContactSurface {
    std::vector<geometry::Vec3> fresh;
    std::vector<std::array<std::int32_t, 3>> triangles;
    std::vector<std::array<std::int32_t, 2>> edges;  ///< each once, lower vertex first, sorted
    std::vector<double> vertex_areas;                ///< a third of the triangles around, fresh
    std::vector<double> edge_areas;

    /// Quadrilaterals are cut from their first to their third corner.
    ContactSurface(std::vector<geometry::Vec3> positions,
                   const std::vector<std::array<std::int32_t, 4>>& quads);

    /// Distance below which no two parts without a common vertex lie in the fresh skin between neighbours:
    /// the smallest height of a triangle.
    double smallest_height() const;
};

/// Two parts without a common vertex.
struct ContactPair {
    ContactKind kind = ContactKind::VertexTriangle;
    std::array<std::int32_t, 4> vertices{};
    double area = 0;  ///< of fresh skin that the pair stands for
};

/// All pairs whose distance is below `reach` plus the largest allowances of their parts' vertices, in an
/// order that depends on the surface's numbering alone. `allowances`: per vertex.
std::vector<ContactPair> find_contact_pairs(const ContactSurface& surface,
                                            const std::vector<geometry::Vec3>& positions, double reach,
                                            const std::vector<double>& allowances);

}  // namespace windfall::drying
