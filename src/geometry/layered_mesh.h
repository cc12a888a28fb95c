#pragma once
// A fruit as a solid: columns of hexahedra from the stone to the skin, one column under every vertex of a
// brick's surface. In a star-shaped body lines run along polar radii, so that they cannot fold; in any other
// body along its inward normals (surface_layers.h).
#include <string>
#include <vector>

#include "geometry/brick_surface.h"
#include "geometry/fruit_shape.h"

namespace windfall::geometry {

/// Thicknesses of the layers, from the stone out, as fractions: flesh layers of the way from stone to skin
/// (sum 1), then skin layers of the skin's thickness (sum 1).
struct LayerFractions {
    std::vector<double> flesh;
    std::vector<double> skin;
    int count() const { return static_cast<int>(flesh.size() + skin.size()); }
};

/// `flesh_layers` layers, each `growth` times as thick as the next one out, and `skin_layers` equal ones.
LayerFractions graded_layers(int flesh_layers, int skin_layers, double growth);

/// The growth for which the outermost of `flesh_layers` layers is `outermost` of the flesh's thickness, in
/// [1, 4].
double growth_for_outermost(int flesh_layers, double outermost);

struct LayeredMesh {
    BrickSurface brick;
    int layers = 0;                ///< elements in a column
    int flesh_layers = 0;          ///< the innermost of them; the rest is skin
    std::vector<Vec3> directions;  ///< per column: its place on the sphere that the surface is laid on, unit
    std::vector<Vec3> outward;     ///< per column: unit vector along it, out through the skin
    std::vector<Vec3> base;        ///< per column: its node on the stone
    std::vector<Vec3> nodes;       ///< [column * layers + k]: node on top of layer k
    /// Functions on the columns, besides the harmonics of `directions`, that a slow displacement of the
    /// surface is made of: one each column of the matrix. None where directions are polar radii.
    Eigen::MatrixXd slow_functions;

    std::size_t columns() const { return directions.size(); }
    const Vec3& node(std::size_t column, int level) const {
        return level == 0 ? base[column] : nodes[column * layers + level - 1];
    }
    /// Positions of all columns at a level: 0 the stone, flesh_layers the flesh's surface, layers the skin's.
    std::vector<Vec3> level_positions(int level) const;
    std::vector<Face> faces() const { return {brick.quads.begin(), brick.quads.end()}; }
};

/// Unit directions, one per vertex of the brick, for which the points spread evenly over an ellipsoid with
/// the given half extents: equal angles on every side of the brick (tan map), stretched to the ellipsoid.
std::vector<Vec3> brick_directions(const BrickSurface& brick, const Vec3& half_extents);

/// The corner whose hexahedron is the most squeezed: triple product of its three edges over the product of
/// their lengths, 1 in a brick, not positive where the hexahedron folds over.
struct WorstCorner {
    double scaled_jacobian = 1;
    Vec3 place = Vec3::Zero();
};
WorstCorner worst_corner(const LayeredMesh& mesh);

/// Throws InputError, with the place and the remedy, where a hexahedron does not have a positive triple
/// product at each of its corners.
void check_corners(const LayeredMesh& mesh, const std::string& remedy);

/// Throws InputError where `check_corners` does.
LayeredMesh make_layered_mesh(const FruitShape& shape, double skin_thickness, const Lattice& cells,
                              const LayerFractions& fractions);

/// n such that a brick n x (m n) x n, m = `elongation`, covers a surface of `area` with quadrilaterals of
/// mean edge `edge`, as `brick_for_edge` rounds it. Throws InputError where it is too large.
int cells_for(double area, double edge, double elongation);
/// The cells n, m n, n with the second rounded as `brick_for_n` does.
Lattice brick_of(int n, double elongation);

/// Cells along x, y, z for which the mean edge on the surface is about `edge`: n, m n, n with both multiples
/// of 8 and m = `elongation`; elongation 0 picks the m of {1, 1.25, 1.5, 2, 3} whose edges vary least.
Lattice brick_for_edge(const FruitShape& shape, double edge, double elongation);
/// The same for a given n.
Lattice brick_for_n(const FruitShape& shape, int n, double elongation);

/// Edge lengths of the surface quads over their mean: how even a mesh is.
struct EdgeStatistics {
    double mean = 0;
    double smallest_over_mean = 0;
    double largest_over_mean = 0;
    double deviation_of_log = 0;
};
EdgeStatistics edge_statistics(const std::vector<Vec3>& positions, const std::vector<Quad>& quads);

}  // namespace windfall::geometry
