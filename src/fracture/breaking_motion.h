#pragma once
// The break as a motion: the branch is pushed over, opens on its tension side, hangs on bridging fibres and a
// hinge, lets go, and the piece falls to the ground and comes to rest.
#include <cstddef>
#include <span>
#include <vector>

#include "core/run_context.h"
#include "fracture/breaking_bonds.h"
#include "fracture/breaking_contact.h"
#include "fracture/breaking_fibre_mesh.h"
#include "fracture/breaking_fibres.h"
#include "fracture/breaking_guide.h"
#include "fracture/breaking_lattice.h"
#include "fracture/breaking_load.h"
#include "fracture/breaking_skin.h"

namespace windfall::fracture {

/// One moment. Vertices in the order of the meshes, in radii, where `shape` of the branch has put them at
/// first.
struct BreakingFrame {
    double time = 0;  ///< s
    std::vector<Vector3f> stub, piece, fibres;
    double bonds_holding = 1;    ///< share of the columns of the lattice across the break
    double fibres_bridging = 1;  ///< share of the bridging fibres
    double bend_deg = 0;         ///< angle between both ends at the break
};

/// Runs one break. The motion depends on the parameters, the ends and `shape` alone, not on the number of
/// threads, and not on output.frames: they only sample it.
class BranchBreaking {
  public:
    /// `ends`: both ends closed, in the unplaced branch with gap 0. `shape`: from there to where they rest.
    BranchBreaking(const FractureParameters& parameters, const BreakEnds& ends, const RestShape& shape);

    int frame_count() const { return m_frames; }
    /// The frame that has been reached; 0, the branch at rest, at first.
    int frame_index() const { return m_frame; }
    /// The bridging fibres at rest, inside of the wood.
    const BranchMesh& fibres() const { return m_fibre_mesh; }
    BreakingFrame frame() const;

    /// Moves on to a later frame. Throws Cancelled (the state is then the one reached), RunError when the
    /// motion is lost.
    void advance_to(int frame, const RunContext& context);

    /// All that the way ahead depends on; `restore` of it goes on to the same bits. Throws InputError when
    /// the bytes are of another break.
    std::vector<std::byte> save() const;
    void restore(std::span<const std::byte> bytes);

    const BreakingLattice& lattice() const { return m_lattice; }
    const Particles& particles() const { return m_particles; }
    const BreakingBonds& bonds() const { return m_bonds; }

  private:
    void step();
    void fall_asleep_if_still();
    void damp();
    double weakening(double time) const;
    double interlocking(double bend) const;
    int step_of(int frame) const;

    BreakingLattice m_lattice;
    BreakingBonds m_bonds;
    BreakingLoad m_load;
    BreakingFibres m_fibres;
    GroundContact m_ground;
    EndContact m_contact;
    LatticeSkin m_stub_skin, m_piece_skin;
    SplinterGuide m_stub_guide, m_piece_guide;
    BranchMesh m_fibre_mesh;
    double m_seconds;
    int m_frames;

    // the state, with that of the members above
    Particles m_particles;
    int m_frame = 0, m_steps_done = 0, m_still = 0;
};

}  // namespace windfall::fracture
