#pragma once
// Maps that a renderer takes, made from the maps of growth: colour, roughness, relief.
#include <cstdint>
#include <vector>

#include "decay/rot_colours.h"
#include "decay/shading_maps_texels.h"
#include "take/frame.h"

namespace windfall::decay {

/// The raw maps of one mesh in a frame. Fungi are the maps "fungus" (one, of the look's species) or
/// "fungus_KEY", with their active shares "fungus_active" or "fungus_active_KEY".
struct RawMaps {
    struct Fungus {
        const take::FrameMap* density = nullptr;  ///< 1: all nutrient has become fungus
        const take::FrameMap* active = nullptr;   ///< share of the density; null: nothing is active
        MoldLook look;
    };
    const take::FrameMap* soft_rot = nullptr;  ///< null: none
    const take::FrameMap* nutrient = nullptr;  ///< of what there was at first; null: all of it
    std::vector<Fungus> fungi;

    /// Those of the maps of `mesh` in a frame (those without a mesh count for every one). InputError when
    /// their sizes differ.
    RawMaps(const take::Frame& frame, const std::string& mesh, const RotLook& look);

    /// The map that gives the size; null when there is no raw map at all.
    const take::FrameMap* any() const;
};

/// Makes the shading maps of one mesh. Holds the fine fixed unevenness of its skin, so that frames are cheap.
class ShadingMaps {
  public:
    /// `texels` are those of the mesh in maps of its size; must outlive this.
    ShadingMaps(const ShadingTexels& texels, const RotLook& look, std::uint64_t seed);

    /// base_color and subsurface_color (sRGB), roughness, normal (tangent space, +x along u, +y along v, as
    /// glTF), displacement (metres along the normal), mold_mask (how much of the skin mold hides), in this
    /// order. InputError when the raw maps have another size than the texels. All on several threads, to the
    /// same bits.
    std::vector<take::FrameMap> make(const RawMaps& raw, const std::string& mesh) const;

    /// Displacement of the values 0 and 65535.
    static constexpr double kLowestDisplacement_m = -1e-3, kHighestDisplacement_m = 2e-3;

  private:
    const ShadingTexels& m_texels;
    RotLook m_look;
    std::vector<LinearColour> m_fresh;  ///< a texel: the fresh skin
    std::vector<float> m_patches;       ///< some millimetres, -1 .. 1
    std::vector<float> m_grains;        ///< some texels, -1 .. 1
};

}  // namespace windfall::decay
