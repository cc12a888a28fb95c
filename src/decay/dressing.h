#pragma once
// Everything that pictures and exports want of a rotten fruit and that the run need not keep: it can be made
// anew from the raw maps of a frame, always to the same bits.
#include <memory>
#include <vector>

#include "decay/mold_hair.h"
#include "decay/rot_colours.h"
#include "take/frame.h"
#include "take/take_info.h"

namespace windfall::decay {

struct DressingSettings {
    RotLook look;
    int strands = 100'000;  ///< of mold a mesh; 0: no hair
    bool shading_maps = true;
    std::uint64_t seed = 0;
};

/// Adds shading maps and hair to frames of one take. May be used from one thread at a time (it keeps what it
/// has worked out for the size of the maps).
class Dressing {
  public:
    Dressing(const std::vector<take::TakeMesh>& meshes, double unit_length_m,
             const DressingSettings& settings);
    /// With the look and the seed that a take holds.
    Dressing(const std::vector<take::TakeMesh>& meshes, const take::TakeInfo& info);
    ~Dressing();
    Dressing(const Dressing&) = delete;
    Dressing& operator=(const Dressing&) = delete;

    /// Adds what is missing, for every mesh that has raw maps in the frame; a frame that has it keeps its
    /// own.
    void dress(take::Frame& frame);

  private:
    struct Skin;
    std::vector<std::unique_ptr<Skin>> m_skins;
    DressingSettings m_settings;
    double m_unit_length_m;
};

}  // namespace windfall::decay
