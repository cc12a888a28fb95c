#pragma once
// Self-contact of the skin: an incremental potential (Li et al. 2020, Incremental Potential Contact) that is
// zero where no two parts of the outer surface are closer than a gap, and endless where they touch.
//
// A pair at the distance d < g, y = d / g, that stands for the fresh area A has the energy
//   A E g b(y) / 24,   b(y) = -(1 - y)^2 ln y,
// E being the stiffness. A vertex and a triangle, or two edges, are pairs unless they share a vertex. By the
// 24 two flat sheets at half the gap press on each other with about E: a place on one is near many parts of
// the other.
#include <optional>

#include "core/aligned_array.h"
#include "drying/column_order.h"
#include "drying/contact_pairs.h"
#include "geometry/layered_mesh.h"

namespace windfall::drying {

struct ContactEnergy {
    double energy = 0;
    int pairs = 0;                 ///< closer than the gap
    double smallest_distance = 0;  ///< of these; 0 without any
};

/// Displacements and forces are [column][3][layers] in solver order, as in Elasticity.
class SkinContact {
  public:
    /// `gap` in r_1, made smaller where the mesh is so fine that neighbours would press on each other when
    /// fresh; `stiffness` in C0 of the flesh. Keeps a copy of what it needs.
    SkinContact(const geometry::LayeredMesh& mesh, const ColumnOrder& order, double gap, double stiffness);

    double gap() const { return m_gap; }

    /// Energy; with `force` not null adds its gradient there.
    ContactEnergy energy(const AlignedArray<double>& displacement, AlignedArray<double>* force);

    /// The part of the straight way between two displacements that nothing on the skin passes through
    /// anything on; 1: all of it. At `from` the skin must not cross itself.
    double free_part(const AlignedArray<double>& from, const AlignedArray<double>& to);

    /// Second derivatives at a displacement, without those of weights and normals: positive semidefinite.
    void linearize(const AlignedArray<double>& displacement);
    /// Adds to the matrix the share that a preconditioner can hold: each node's own block.
    void add_to_diagonal(const MatrixArrays& matrix) const;
    /// y += what `add_to_diagonal` left out, times x; returns what that adds to x y.
    double add_product(const float* x, float* y) const;

  private:
    /// A pair closer than the gap.
    struct Press {
        const ContactPair* pair = nullptr;
        ContactGap gap;
        Mollifier mollifier;
    };
    /// The second derivative of a press: the square of this vector.
    struct Term {
        std::array<std::int32_t, 4> vertices{};
        std::array<float, 12> direction{};
    };
    std::vector<geometry::Vec3> positions(const AlignedArray<double>& displacement) const;
    bool covers(const std::vector<geometry::Vec3>& positions) const;
    void find_pairs(const std::vector<geometry::Vec3>& from, const std::vector<geometry::Vec3>& to);
    std::vector<Press> presses(const std::vector<geometry::Vec3>& x) const;
    std::size_t place(std::int32_t vertex) const {
        return (static_cast<std::size_t>(vertex) * 3 + 1) * m_layers - 1;
    }

    std::size_t m_layers;
    ContactSurface m_surface;
    double m_gap;
    double m_stiffness;
    // The pairs that can come closer than the gap while no vertex leaves its allowance around its anchor,
    // but for a common factor of all positions: a fruit shrinks.
    std::vector<geometry::Vec3> m_anchors;
    std::vector<double> m_allowances;
    std::vector<ContactPair> m_pairs;
    std::vector<Term> m_terms;
};

}  // namespace windfall::drying
