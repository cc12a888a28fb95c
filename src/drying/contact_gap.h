#pragma once
// Distances between the parts of a triangulated surface that can touch first: a vertex and a triangle, or two
// edges.
#include <array>

#include "geometry/surface_mesh.h"

namespace windfall::drying {

/// Which two parts four points are: a vertex and the corners of a triangle, or the ends of two edges.
enum class ContactKind { VertexTriangle, EdgeEdge };

using FourPoints = std::array<geometry::Vec3, 4>;

/// The shortest way between the two parts: the sum of weights times points, of the given length. As the
/// weights minimise the length, its gradient at point i is weights[i] times `normal`.
struct ContactGap {
    std::array<double, 4> weights{};
    geometry::Vec3 normal = geometry::Vec3::Zero();  ///< unit vector; zero where the parts touch
    double distance = 0;
};
ContactGap contact_gap(ContactKind kind, const FourPoints& points);

/// Takes away the kink that the distance of two edges has where they are parallel: 0 there, 1 from a sine of
/// the angle on that is about a thirtieth (Li et al. 2020, Incremental Potential Contact, eq. (23)).
/// `fresh_squares`: product of the squared lengths of the two fresh edges.
struct Mollifier {
    double value = 1;
    std::array<geometry::Vec3, 4> gradient{geometry::Vec3::Zero(), geometry::Vec3::Zero(),
                                           geometry::Vec3::Zero(), geometry::Vec3::Zero()};
};
Mollifier edge_mollifier(const FourPoints& points, double fresh_squares);

/// A lower bound of the part of the way `motion` after which the two parts would touch, by conservative
/// advancement (Li et al. 2021, Codimensional Incremental Potential Contact, algorithm 1): over that part a
/// tenth of the distance at the start remains, or of `gap` if that is less. 1 where all of the way is free.
double free_part_of_way(ContactKind kind, const FourPoints& points, const FourPoints& motion, double gap);

}  // namespace windfall::drying
