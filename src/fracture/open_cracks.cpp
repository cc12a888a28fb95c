#include "fracture/open_cracks.h"

#include <algorithm>
#include <array>

#include "fracture/crack_motion.h"
#include "fracture/crack_slit.h"
#include "fracture/crack_thorns.h"
#include "fracture/crack_walls.h"

namespace windfall::fracture {
namespace {

using PlanPoints = std::vector<Eigen::Vector2d>;

constexpr double kDeepestSlit = 0.9;  // of the shorter end
// What wandering rays and open cracks leave of the Jacobian at a face's corner.
constexpr double kLeastOfRays = 0.3, kLeastOfFaces = 0.05;
constexpr int kMostTrials = 40;

/// The big check does not leave the wood: the broken edge of the bark stays whole.
CrackSet cracks_in_wood(const FractureParameters& parameters, const CrackGrid& grid) {
    CrackSet set = draw_cracks(parameters, crack_room(grid));
    for (Crack& crack : set.cracks)
        if (crack.reaches_bark()) {
            crack.end = std::min(0.98, 1 - parameters.tissue.phloem);
            if (limit_width(crack)) ++set.count.narrowed;
        }
    return set;
}

PlanPoints plan_of(const BranchMesh& mesh) {
    PlanPoints plan;
    plan.reserve(mesh.positions.size());
    for (const Vector3f& p : mesh.positions) plan.emplace_back(p.x(), p.y());
    return plan;
}

double corner_jacobian(const PlanPoints& plan, const geometry::Face& face, std::size_t count, std::size_t k) {
    const auto at = [&](std::size_t i) { return plan[static_cast<std::size_t>(face[i % count])]; };
    const Eigen::Vector2d forward = at(k + 1) - at(k), back = at(k + count - 1) - at(k);
    return forward.x() * back.y() - forward.y() * back.x();
}

class CrackOpener {
  public:
    CrackOpener(const FractureParameters& parameters, BreakEnds& ends)
        : m_ends(ends),
          m_grid(crack_grid(parameters)),
          m_section(parameters, m_grid, cracks_in_wood(parameters, m_grid),
                    kDeepestSlit * std::min(parameters.branch.length, parameters.branch.piece_length)),
          m_motion(parameters, m_section) {}

    CrackCount open() {
        m_slits = slit_ends(m_section, m_ends);
        std::size_t bottoms = 0;
        for (const Slit& slit : m_slits) bottoms += slit.size() - 2;
        m_before = plan_of(m_ends.stub);
        m_before.resize(static_cast<std::size_t>(m_ends.surface_vertices) + bottoms);
        m_cells = cells_of_vertices(m_section, m_ends.cells, m_slits, m_before.size());
        m_after = m_before;
        move_until_sound();
        place(m_ends.stub);
        place(m_ends.piece);
        add_walls(m_ends.stub, true);
        add_walls(m_ends.piece, false);
        return m_section.count();
    }

  private:
    void move_surface() {
        for (std::size_t v = 0; v < m_before.size(); ++v)
            m_after[v] = m_motion.moved_apart(m_before[v], m_cells[v]);
        for (std::size_t k = 0; k < m_slits.size(); ++k)
            for (const SlitVertex& v : m_slits[k])
                if (v.left != v.right) {
                    const auto bottom = static_cast<std::size_t>(v.bottom);
                    m_after[bottom] = m_motion.moved_apart(m_before[bottom], m_cells[bottom], k);
                }
        m_motion.wander(m_after);
    }

    void move_until_sound() {
        for (int trial = 1; trial <= kMostTrials; ++trial) {
            move_surface();
            const std::vector<CrackedSection::Cell> folds = folded_cells(kLeastOfFaces);
            if (folds.empty()) return;
            if (trial == 1) calm_rays();
            m_section.narrow_around(folds);
            if (trial % 4 == 0) m_motion.calm();
        }
        // Closed cracks on rays that do not wander leave everything where it was.
        while (true) {
            move_surface();
            const std::vector<CrackedSection::Cell> folds = folded_cells(kLeastOfFaces);
            if (folds.empty() || (!m_section.close_around(folds) && !m_motion.stop_wander())) return;
        }
    }

    /// Lets the rays wander less until they leave room for cracks.
    void calm_rays() {
        for (int trial = 0; trial < kMostTrials; ++trial) {
            m_after = m_before;
            m_motion.wander(m_after);
            if (folded_cells(kLeastOfRays).empty()) return;
            m_motion.calm();
        }
    }

    /// Adds the cells where a slit runs backwards, so that its sides cannot be drawn apart, or its walls
    /// fold.
    void add_folded_slits(std::vector<CrackedSection::Cell>& cells) const {
        for (std::size_t k = 0; k < m_slits.size(); ++k)
            for (std::size_t i = 0; i + 1 < m_slits[k].size(); ++i) {
                const auto from = static_cast<std::size_t>(m_slits[k][i].left);
                const auto to = static_cast<std::size_t>(m_slits[k][i + 1].left);
                const Eigen::Vector2d &a = m_after[from], &b = m_after[to];
                const bool radial = m_section.cracks()[k].crack.radial();
                const bool turns = radial ? b.norm() <= a.norm() : a.x() * b.y() - a.y() * b.x() <= 0;
                if (turns || wall_folds(m_slits[k][i], m_slits[k][i + 1]))
                    cells.push_back({m_cells[from].ring, m_cells[from].sector});
            }
    }

    /// Whether the walls between two places along a crack are turned over somewhere, in plan.
    bool wall_folds(const SlitVertex& a, const SlitVertex& b) const {
        const std::array<geometry::Face, 2> walls{
            {{a.left, a.bottom, b.bottom, b.left}, {a.bottom, a.right, b.right, b.bottom}}};
        for (const geometry::Face& wall : walls)
            for (std::size_t k = 0; k < 4; ++k)
                if (corner_jacobian(m_after, wall, 4, k) < 0) return true;
        return false;
    }

    /// Cells where a corner of a face has kept less than `least` of its Jacobian, or a slit folds.
    std::vector<CrackedSection::Cell> folded_cells(double least) const {
        std::vector<CrackedSection::Cell> result;
        add_folded_slits(result);
        // Corners that were as good as straight before are no folds.
        const double flat = 1e-3 * m_grid.sector_angle() / (m_grid.rings * m_grid.rings);
        for (std::size_t f = 0; f < m_ends.surface_faces; ++f) {
            const geometry::Face& face = m_ends.stub.faces[f];
            const auto count = static_cast<std::size_t>(geometry::corner_count(face));
            for (std::size_t k = 0; k < count; ++k) {
                const double before = corner_jacobian(m_before, face, count, k);
                if (before <= flat || corner_jacobian(m_after, face, count, k) >= least * before) continue;
                const SurfaceCell& cell = m_cells[static_cast<std::size_t>(face[k])];
                result.push_back({cell.ring, cell.sector});
            }
        }
        return result;
    }

    /// Surface and bottoms as they were moved, and thorns with them.
    void place(BranchMesh& mesh) const {
        for (std::size_t v = 0; v < m_after.size(); ++v)
            mesh.positions[v].head<2>() = m_after[v].cast<float>();
        carry_thorns({m_section, m_motion, m_ends.cells, m_ends.surface_faces, m_before, m_after}, mesh);
        const double down = &mesh == &m_ends.stub ? -1 : 1;
        for (std::size_t k = 0; k < m_slits.size(); ++k)
            for (const SlitVertex& v : m_slits[k]) {
                if (v.left == v.right) continue;
                const auto bottom = static_cast<std::size_t>(v.bottom);
                mesh.positions[bottom].z() +=
                    static_cast<float>(down * CrackMotion::depth(m_section.cracks()[k], v.node));
                mesh.height[bottom] = mesh.positions[bottom].z();
            }
    }

    void add_walls(BranchMesh& mesh, bool downwards) const {
        for (const Slit& slit : m_slits) {
            double arc = 0;
            for (std::size_t i = 0; i + 1 < slit.size(); ++i) {
                const double step = (m_before[static_cast<std::size_t>(slit[i + 1].left)] -
                                     m_before[static_cast<std::size_t>(slit[i].left)])
                                        .norm();
                add_wall_faces(column(slit[i], arc), column(slit[i + 1], arc + step), 1, downwards, mesh);
                arc += step;
            }
        }
    }

    static WallColumn column(const SlitVertex& v, double arc) {
        if (v.left == v.right) return {{v.left}, {v.left}, arc};
        return {{v.left, v.bottom}, {v.right, v.bottom}, arc};
    }

    BreakEnds& m_ends;
    CrackGrid m_grid;
    CrackedSection m_section;
    CrackMotion m_motion;
    std::vector<Slit> m_slits;
    std::vector<SurfaceCell> m_cells;
    PlanPoints m_before, m_after;  // of the surface's vertices and the bottoms; the same in both ends
};

}  // namespace

CrackCount open_cracks(BreakEnds& ends, const FractureParameters& parameters) {
    return CrackOpener(parameters, ends).open();
}

}  // namespace windfall::fracture
