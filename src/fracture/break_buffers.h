#pragma once
// What a break is made of on the way: flat arrays over the cells and nodes of the polar lattice. Not for
// users.
#include <array>
#include <cstdint>
#include <vector>

#include "fracture/branch_mesh.h"
#include "fracture/break_ends.h"
#include "fracture/bundles.h"

namespace windfall::fracture {

/// Height of an arc over its chord that an irregular outline adds, over that of the circle and per
/// branch.outline; and how much of a cell it may be where thorns stand.
inline constexpr double kOutlineBend = 6, kMostOutlineBend = 0.1;

/// The lattice over the cross-section. Node (R, S), R = 0 .. rings, and cell (R, S), R = 0 .. rings - 1, have
/// index R * sectors + S. Ring 0 of nodes is the pith.
struct PolarLattice {
    int rings = 0, sectors = 0;
    std::vector<float> node_x, node_y;  ///< jittered
    std::vector<float> sector_angle;    ///< of the nodes' rays, not jittered
    std::vector<float> rim_angle;       ///< of the outermost nodes, as jittered
    std::size_t cell(int ring, int sector) const {
        return static_cast<std::size_t>(ring) * static_cast<std::size_t>(sectors) +
               static_cast<std::size_t>(sector);
    }
    std::size_t cells() const { return cell(rings, 0); }
};

/// How each cell breaks: z = height + slope_x x + slope_y y for all cells of a run with one name.
struct BreakCells {
    std::vector<std::uint32_t> name;  ///< cells side by side with different names have a wall between them
    std::vector<float> height, slope_x, slope_y;
    std::vector<Tissue> tissue;
    std::vector<float> thorn;  ///< length of the stub's thorn that stands here; of the piece's where < 0
    std::vector<std::int32_t> fibre;  ///< index into thorns; -1: none
};

/// A place where one end has a thorn and the other a hole. Its cells have a name of their own.
struct ThornSite {
    float length = 0;  ///< > 0: on the stub, < 0: on the piece
    bool strand = false;
    std::uint32_t shape = 0;  ///< random bits
    float centre_x = 0, centre_y = 0;
    int ring = 0, sector = 0;  ///< the cell of it that is nearest to the centre
    float distance = 0;        ///< of that cell, squared
    std::uint32_t name = 0;    ///< of the cells before they got their own
};

/// What is known of a vertex of the broken surface besides its place.
struct SurfaceVertices {
    std::vector<float> x, y, z, thorn;
    std::vector<std::uint32_t> name;
    std::vector<std::uint32_t> particle;  ///< the node of the lattice, ring and sector in 16 bits each
    std::vector<Tissue> tissue;
};

struct BreakWorkspace::Buffers {
    PolarLattice lattice;
    BreakCells cells;
    std::vector<ThornSite> sites;
    std::vector<BundleTable> tables;
    BundleTable bark_table;
    SurfaceVertices vertices;
    std::vector<float> warped_radius, warped_angle, centre_x, centre_y, roughness;
    std::vector<float> amplitude, frequency;
    std::vector<std::int32_t> site_of_bundle;
    std::vector<std::uint32_t> finest_bundle;  ///< of each cell of wood, in the last table
};

/// Nodes of the lattice, each moved by up to a tenth of a cell so that no ray and no ring is straight.
void lay_out_lattice(const FractureParameters& parameters, PolarLattice& lattice);

/// Tilt, layers, bundles, thorns: heights and names of all cells.
void fill_cells(const FractureParameters& parameters, BreakWorkspace::Buffers& buffers);

/// Vertices (holes not yet made), faces and rim of the surface that both ends share, as the stub's.
void build_surface(const FractureParameters& parameters, BreakWorkspace::Buffers& buffers, BreakEnds& ends);

/// Thorns and strands: closed bodies that stand in the holes of the other end.
void add_thorns(const FractureParameters& parameters, const BreakWorkspace::Buffers& buffers,
                BreakEnds& ends);

}  // namespace windfall::fracture
