#pragma once
// A drying take on an artist's own mesh: vertices in their order, faces and texture coordinates as they are
// in the file; only positions move.
#include "drying/artist_fruit.h"
#include "geometry/layered_mesh.h"
#include "geometry/surface_transfer.h"
#include "take/frame.h"

namespace windfall::drying {

/// Carries frames of the solver's skin over to the artist's mesh. Immutable.
class ArtistSkin {
  public:
    /// `mesh`: the fresh body, imperfection included, from which the artist's vertices hang. Keeps a
    /// reference to `fruit`.
    ArtistSkin(const ArtistFruit& fruit, const geometry::LayeredMesh& mesh);

    take::TakeMesh take_mesh() const;
    /// Puts the artist's mesh in the place of the skin: moved positions, attributes as they are on the skin
    /// there.
    void carry(take::Frame& frame) const;

  private:
    const ArtistFruit& m_fruit;
    geometry::SurfaceTransfer m_transfer;
};

/// A warning where edges of the artist's mesh are too long to show the wrinkles.
std::vector<std::string> check_resolution(const ArtistFruit& fruit, double wave_length);

}  // namespace windfall::drying
