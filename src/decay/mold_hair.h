#pragma once
// Mold as hair: strands that stand on the skin where the fungus map says so.
#include <cstdint>
#include <vector>

#include "decay/shading_maps.h"
#include "take/frame.h"

namespace windfall::decay {

struct MoldHairSettings {
    int strands = 100'000;  ///< that stand when all of the skin is moldy, 1 .. 200,000
    std::uint64_t seed = 0;
};

/// Grows the hair of one mesh. A strand is a function of the seed and its number alone: it stands at the same
/// place of the skin in all frames, and appears and grows with the mold there. Read-only once made.
class MoldHair {
  public:
    /// InputError when the mesh has no texture coordinates or no area, or for a number of strands that cannot
    /// be.
    MoldHair(const take::TakeMesh& mesh, double unit_length_m, const MoldHairSettings& settings);

    /// The hair at one moment: "mold" (a dense short fur), "whiskers" (long single ones) and "sporangia"
    /// (dark heads on whiskers, as short thick strands); those without a strand are left out. `moved` must
    /// have the vertices of the mesh. Lengths in the take's unit. On several threads, to the same bits.
    std::vector<take::FrameCurves> grow(const RawMaps& raw, const take::FrameMesh& moved) const;

  private:
    struct Root {
        std::int32_t face;
        Eigen::Vector2f place, uv;
    };
    take::TakeMesh m_mesh;
    double m_unit_length_m;
    MoldHairSettings m_settings;
    std::vector<Root> m_roots;  // in the order of the strands' numbers
};

}  // namespace windfall::decay
