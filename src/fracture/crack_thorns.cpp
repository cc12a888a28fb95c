#include "fracture/crack_thorns.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace windfall::fracture {
namespace {

/// A point of the plan in the lattice: its cell, and where in it, 0 .. 1 outwards and around.
struct ThornPlace {
    SurfaceCell cell;
    double outwards, around;
};

ThornPlace thorn_place(const CrackGrid& grid, const Eigen::Vector2d& point) {
    const double turns = std::atan2(point.y(), point.x()) / (2 * std::numbers::pi);
    const double along_ring = turns * grid.sectors, along_ray = point.norm() * grid.rings;
    const int ring = std::clamp(static_cast<int>(along_ray), 0, grid.rings - 1);
    const double sector = std::floor(along_ring);
    return {{ring, grid.wrapped_sector(static_cast<int>(sector))},
            std::clamp(along_ray - ring, 0.0, 1.0),
            along_ring - sector};
}

class ThornCarrier {
  public:
    ThornCarrier(const MovedSurface& surface, BranchMesh& mesh)
        : m_surface(surface),
          m_mesh(mesh),
          m_first(surface.before.size()),
          m_parent(mesh.positions.size() - m_first) {}

    void carry() {
        join_bodies();
        std::vector<Eigen::Vector2d> across;  // vertices of thorns that stand across a crack
        std::vector<std::size_t> across_vertices;
        const std::vector<Root> roots = find_roots();
        std::vector<bool> is_across(m_parent.size(), false);
        for (std::size_t v = 0; v < m_parent.size(); ++v)
            if (parted(roots[body(v)].cell, at(v).cell)) is_across[body(v)] = true;
        for (std::size_t v = 0; v < m_parent.size(); ++v) {
            if (is_across[body(v)]) {
                across.push_back(m_surface.motion.moved_apart(plan(v), roots[body(v)].cell));
                across_vertices.push_back(v);
            } else {
                place(v, plan(v) + shift_of_cell(at(v)));
            }
        }
        m_surface.motion.wander(across);
        for (std::size_t i = 0; i < across.size(); ++i) place(across_vertices[i], across[i]);
    }

  private:
    struct Root {
        Eigen::Vector2d sum = Eigen::Vector2d::Zero();
        int count = 0;
        SurfaceCell cell{0, 0};
    };

    Eigen::Vector2d plan(std::size_t v) const {
        return m_mesh.positions[m_first + v].head<2>().cast<double>();
    }
    void place(std::size_t v, const Eigen::Vector2d& point) {
        m_mesh.positions[m_first + v].head<2>() = point.cast<float>();
    }
    ThornPlace at(std::size_t v) const { return thorn_place(m_surface.section.grid(), plan(v)); }

    /// The number of the thorn that a vertex belongs to: that of one of its vertices.
    std::size_t body(std::size_t v) const {
        while (m_parent[v] != v) v = m_parent[v];
        return v;
    }

    void join_bodies() {
        std::iota(m_parent.begin(), m_parent.end(), std::size_t{0});
        for (std::size_t f = m_surface.faces; f < m_mesh.faces.size(); ++f) {
            const geometry::Face& face = m_mesh.faces[f];
            for (const std::int32_t v : face) {
                if (v == geometry::kNoVertex) continue;
                const std::size_t a = body(static_cast<std::size_t>(v) - m_first),
                                  b = body(static_cast<std::size_t>(face[0]) - m_first);
                m_parent[std::max(a, b)] = std::min(a, b);
            }
        }
    }

    std::vector<Root> find_roots() const {
        std::vector<Root> roots(m_parent.size());
        for (std::size_t v = 0; v < m_parent.size(); ++v) {
            if (m_mesh.thorn[m_first + v] > 0) continue;
            roots[body(v)].sum += plan(v);
            ++roots[body(v)].count;
        }
        for (Root& root : roots)
            if (root.count > 0) root.cell = thorn_place(m_surface.section.grid(), root.sum / root.count).cell;
        return roots;
    }

    /// Whether a crack may run between two cells.
    bool parted(const SurfaceCell& a, const SurfaceCell& b) const {
        const CrackGrid& grid = m_surface.section.grid();
        for (const std::uint32_t index : m_surface.section.moving(a.sector)) {
            const LatticeCrack& c = m_surface.section.cracks()[index];
            const auto is_left = [&](const SurfaceCell& cell) {
                return c.crack.radial() ? 2 * grid.wrapped_sector(cell.sector - c.line) < grid.sectors
                                        : cell.ring < c.line;
            };
            const auto is_beside = [&](const SurfaceCell& cell) {
                if (c.crack.radial()) return cell.ring >= c.begin && cell.ring < c.end;
                return grid.wrapped_sector(cell.sector - c.begin) < c.end - c.begin;
            };
            if (is_left(a) != is_left(b) && (is_beside(a) || is_beside(b))) return true;
        }
        return false;
    }

    Eigen::Vector2d shift_of_cell(const ThornPlace& p) const {
        const auto& corners = m_surface.cells.of(p.cell.ring, p.cell.sector);
        const auto shift = [&](std::size_t k) -> Eigen::Vector2d {
            const auto v = static_cast<std::size_t>(corners[k]);
            return m_surface.after[v] - m_surface.before[v];
        };
        return (1 - p.around) * ((1 - p.outwards) * shift(0) + p.outwards * shift(1)) +
               p.around * ((1 - p.outwards) * shift(3) + p.outwards * shift(2));
    }

    const MovedSurface& m_surface;
    BranchMesh& m_mesh;
    std::size_t m_first;                // vertex of a thorn
    std::vector<std::size_t> m_parent;  // another vertex of the same thorn with a lower number, or itself
};

}  // namespace

void carry_thorns(const MovedSurface& surface, BranchMesh& mesh) { ThornCarrier(surface, mesh).carry(); }

}  // namespace windfall::fracture
