#pragma once
// The skin: an elastic sheet that keeps its own size while the flesh below shrinks, tied to it by a bed of
// springs, and so wrinkles.
//
//   E = sum_edges k/2 (l - L)^2 + sum_i K A/2 |d_i|^2 + sum_i b/2 |d_i - mean d|^2 + proximal,   d = x - y
//
// with y the place of the vertex on the flesh, set in a little: compressed skin on a round fruit pushes
// outwards, and the inset is such that skin and flesh enclose the same volume. A sheet on such a bed buckles
// at the wave length 2 pi (B/K)^(1/4) at the strain 2 sqrt(K B) / (E t) (Biot 1937, Bending of an infinite
// beam on an elastic foundation): B and K are chosen for both. Solved by vertex block descent (Chen, Liu,
// Yang, Yuksel 2024, doi:10.1145/3658179), colour by colour.
#include <Eigen/Core>
#include <vector>

#include "decay/body_ground.h"
#include "decay/skin_mesh.h"

namespace windfall::decay {

struct SkinMaterial {
    double thickness_m = 0;
    double wave_length_m = 0;
    double membrane_n_m = 0;  ///< E t
    double bending_nm = 0;    ///< B
    double tether_pa_m = 0;   ///< K
};

/// `wave_length_m` 0: that of a stiff sheet on a soft half-space, 2 pi t (E_s / 3 E_f)^(1/3) (Allen 1969),
/// but at least five of the mesh's edges and at most 20 mm.
SkinMaterial skin_material(double skin_modulus_pa, double thickness_m, double flesh_modulus_pa,
                           double mean_edge_m, double wave_length_m);

class Skin {
  public:
    using Positions = std::vector<Eigen::Vector3f>;

    /// Lies on the flesh at `positions` (in the order of the brick), at rest.
    Skin(const geometry::BrickSurface& brick, const std::vector<geometry::Vec3>& positions);

    const SkinMesh& mesh() const { return m_mesh; }
    void set_material(const SkinMaterial& material);

    /// Lays the skin on `target`, stretched nowhere; `stretch` per vertex: how much longer than there its
    /// springs are (0.02: 2 %).
    void lay(const Positions& target, const std::vector<float>& stretch);

    /// One frame: goes with the flesh to `target`, then relaxes. Planes are per vertex, `neighbour` may be
    /// empty.
    void advance(const Positions& target, const std::vector<ContactPlane>& ground,
                 const std::vector<ContactPlane>& neighbour);

    const Positions& positions() const { return m_positions; }
    /// Energy without the proximal term (J).
    double energy_j() const;

    template <class Archive>
    void serialise(Archive& archive) {
        archive(m_x);
        archive(m_target);
        archive(m_rest_lengths);
        archive(m_slack);
        archive(m_inset_m);
        archive(m_longest_move);
        if constexpr (Archive::kReading) publish();
    }

  private:
    using Vec4 = Eigen::Vector4f;

    void loosen_folds();
    void place_target(const Positions& target);
    void cap_lengths();
    void correct_inset();
    void find_bending();
    void sweep(bool forwards);
    void move(std::int32_t i);
    void publish();

    SkinMesh m_mesh;
    SkinMaterial m_material;
    // In the order of the mesh's colours.
    std::vector<Vec4> m_x, m_target, m_start, m_bend;  ///< m_bend: d - mean d
    std::vector<float> m_rest_lengths, m_lengths;  ///< per neighbour; as laid, and as capped for this frame
    std::vector<float> m_slack;  ///< per vertex: share of its excess length that a fold has left it
    std::vector<float> m_bending, m_tether, m_hessian;
    std::vector<ContactPlane> m_ground, m_neighbour;
    std::vector<float> m_room;  ///< 1 where the skin is free to buckle .. 0 where it touches something
    std::vector<Vec4> m_flesh, m_flesh_areas;  ///< where the flesh is, and its area vectors
    float m_inset_m = 0;
    float m_longest_move = 0;
    Positions m_positions;
};

}  // namespace windfall::decay
