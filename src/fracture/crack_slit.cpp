#include "fracture/crack_slit.h"

#include <algorithm>

#include "core/error.h"

namespace windfall::fracture {
namespace {

using geometry::Face;

/// Along a ray on its cells' first edges, along a ring on its cells' inner ones; from cell to cell up or down
/// the wall between them.
Slit way_of(const LatticeCrack& crack, const CrackGrid& grid, const CellCorners& cells) {
    Slit way;
    const auto step_to = [&](std::int32_t v, int node) {
        if (way.empty() || way.back().left != v) way.push_back({v, v, v, node});
    };
    for (int along = crack.begin; along < crack.end; ++along) {
        const bool radial = crack.crack.radial();
        const auto& corners =
            radial ? cells.of(along, crack.line) : cells.of(crack.line, grid.wrapped_sector(along));
        step_to(corners[0], along);
        step_to(corners[radial ? 1 : 3], along + 1);
    }
    return way;
}

/// Makes room for new vertices behind the first `old_count`: copies of `originals`.
void insert_vertices(BranchMesh& mesh, std::size_t old_count, const std::vector<std::int32_t>& originals) {
    const auto insert = [&](auto& values) {
        if (values.empty()) return;
        auto copies = values;
        copies.clear();
        for (const std::int32_t v : originals) copies.push_back(values[static_cast<std::size_t>(v)]);
        values.insert(values.begin() + static_cast<std::ptrdiff_t>(old_count), copies.begin(), copies.end());
    };
    insert(mesh.positions);
    insert(mesh.height);
    insert(mesh.thorn);
    insert(mesh.tissue);
    insert(mesh.bundle);
    for (Face& face : mesh.faces)
        for (std::int32_t& v : face)
            if (v >= static_cast<std::int32_t>(old_count)) v += static_cast<std::int32_t>(originals.size());
}

/// The faces around some of a mesh's vertices.
class FacesAround {
  public:
    /// `wanted`: by vertex, its number among those that are wanted, or -1.
    FacesAround(const BranchMesh& mesh, const std::vector<std::int32_t>& wanted, std::size_t wanted_count)
        : m_mesh(mesh), m_wanted(wanted), m_faces(wanted_count) {
        for (std::size_t f = 0; f < mesh.faces.size(); ++f)
            for (const std::int32_t v : mesh.faces[f])
                if (v >= 0 && wanted[static_cast<std::size_t>(v)] >= 0)
                    m_faces[static_cast<std::size_t>(wanted[static_cast<std::size_t>(v)])].push_back(f);
    }

    /// The faces around `v` on the right of the way from `before` over `v` to `behind`, seen from above; the
    /// mesh's faces are seen from above (`up`) or from below.
    std::vector<std::size_t> right_of(std::int32_t before, std::int32_t v, std::int32_t behind,
                                      bool up) const {
        // Seen from the faces' own side, the part sought is on the left of the way that leads to `to`.
        std::int32_t from = up ? before : behind;
        const std::int32_t to = up ? behind : before;
        std::vector<std::size_t> result;
        while (from != to) {
            const Edge edge = face_with_edge(v, from);
            result.push_back(edge.face);
            from = edge.previous;
        }
        return result;
    }

  private:
    struct Edge {
        std::size_t face;
        std::int32_t previous;  // corner of the face before `v`
    };

    /// The face that runs from v to next.
    Edge face_with_edge(std::int32_t v, std::int32_t next) const {
        for (const std::size_t f : m_faces[static_cast<std::size_t>(m_wanted[static_cast<std::size_t>(v)])]) {
            const Face& face = m_mesh.faces[f];
            const auto count = static_cast<std::size_t>(geometry::corner_count(face));
            for (std::size_t k = 0; k < count; ++k)
                if (face[k] == v && face[(k + 1) % count] == next) return {f, face[(k + count - 1) % count]};
        }
        throw RunError("a crack left the edges of the broken surface");
    }

    const BranchMesh& m_mesh;
    const std::vector<std::int32_t>& m_wanted;
    std::vector<std::vector<std::size_t>> m_faces;
};

/// Gives the faces on the right of all slits the vertices of the right side.
void part_faces(const std::vector<Slit>& slits, bool up, BranchMesh& mesh) {
    std::vector<std::int32_t> wanted(mesh.positions.size(), -1);
    std::int32_t count = 0;
    for (const Slit& slit : slits)
        for (const SlitVertex& v : slit)
            if (v.left != v.right) wanted[static_cast<std::size_t>(v.left)] = count++;
    struct Change {
        std::size_t face;
        std::int32_t left, right;
    };
    std::vector<Change> changes;
    const FacesAround around(mesh, wanted, static_cast<std::size_t>(count));
    for (const Slit& slit : slits)
        for (std::size_t i = 1; i + 1 < slit.size(); ++i)
            for (const std::size_t f : around.right_of(slit[i - 1].left, slit[i].left, slit[i + 1].left, up))
                changes.push_back({f, slit[i].left, slit[i].right});
    for (const Change& change : changes)
        std::replace(mesh.faces[change.face].begin(), mesh.faces[change.face].end(), change.left,
                     change.right);
}

/// The cells on the right of a slit's node: two of the four around it.
std::array<SurfaceCell, 2> cells_right_of(const LatticeCrack& crack, const CrackGrid& grid, int node) {
    if (crack.crack.radial()) {
        const int sector = grid.wrapped_sector(crack.line - 1);
        return {{{node, sector}, {node - 1, sector}}};
    }
    return {{{crack.line, grid.wrapped_sector(node)}, {crack.line, grid.wrapped_sector(node - 1)}}};
}

SurfaceCell cell_left_of(const LatticeCrack& crack, const CrackGrid& grid, int node) {
    if (crack.crack.radial()) return {node, crack.line};
    return {crack.line - 1, grid.wrapped_sector(node)};
}

}  // namespace

std::vector<Slit> slit_ends(const CrackedSection& section, BreakEnds& ends) {
    std::vector<Slit> slits;
    std::vector<std::int32_t> parted;
    const std::int32_t first = ends.surface_vertices;
    for (const LatticeCrack& crack : section.cracks()) {
        slits.push_back(way_of(crack, section.grid(), ends.cells));
        for (std::size_t i = 1; i + 1 < slits.back().size(); ++i) parted.push_back(slits.back()[i].left);
    }
    const auto count = static_cast<std::int32_t>(parted.size());
    std::int32_t next = first;
    for (Slit& slit : slits)
        for (std::size_t i = 1; i + 1 < slit.size(); ++i, ++next) {
            slit[i].right = next;
            slit[i].bottom = next + count;
        }
    std::vector<std::int32_t> originals = parted;
    originals.insert(originals.end(), parted.begin(), parted.end());
    for (BranchMesh* mesh : {&ends.stub, &ends.piece}) {
        insert_vertices(*mesh, static_cast<std::size_t>(first), originals);
        part_faces(slits, mesh == &ends.stub, *mesh);
    }
    ends.surface_vertices += count;
    for (std::size_t k = 0; k < slits.size(); ++k)
        for (const SlitVertex& v : slits[k]) {
            if (v.left == v.right) continue;
            for (const SurfaceCell& c : cells_right_of(section.cracks()[k], section.grid(), v.node)) {
                auto& corners = ends.cells.corners[section.grid().node(c.ring, c.sector)];
                std::replace(corners.begin(), corners.end(), v.left, v.right);
            }
        }
    return slits;
}

std::vector<SurfaceCell> cells_of_vertices(const CrackedSection& section, const CellCorners& cells,
                                           const std::vector<Slit>& slits, std::size_t count) {
    std::vector<SurfaceCell> result(count, {0, 0});
    for (int r = 0; r < cells.rings; ++r)
        for (int s = 0; s < cells.sectors; ++s)
            for (const std::int32_t v : cells.of(r, s)) result[static_cast<std::size_t>(v)] = {r, s};
    for (std::size_t k = 0; k < slits.size(); ++k)
        for (const SlitVertex& v : slits[k]) {
            const SurfaceCell left = cell_left_of(section.cracks()[k], section.grid(), v.node);
            result[static_cast<std::size_t>(v.left)] = result[static_cast<std::size_t>(v.bottom)] = left;
            if (v.left != v.right)
                result[static_cast<std::size_t>(v.right)] =
                    cells_right_of(section.cracks()[k], section.grid(), v.node)[0];
        }
    return result;
}

}  // namespace windfall::fracture
