#pragma once
// Puts a frame of a take into the studio: pose, floor, lights, colours.
#include <memory>
#include <span>
#include <vector>

#include "picture/colouring.h"
#include "picture/fruit_surface.h"
#include "picture/look.h"
#include "picture/scene.h"
#include "picture/wood_surface.h"
#include "take/frame.h"

namespace windfall::picture {

struct StageSettings {
    Look look;  ///< of fruit; wood is coloured by the take itself
    Colouring colouring = Colouring::Material;
    double azimuth_deg = 25;
    double elevation_deg = 22;
    int picture_size = 480;      ///< pixels; decides how finely the skin of fruit is refined
    double final_shrinkage = 0;  ///< shrinkage at which the skin has its dry colour; 0: it stays fresh
    ColourRange colour_range;    ///< of the false colours
    View view = View::Whole;     ///< of wood
};

/// Whether these meshes are of wood: they have materials.
bool is_wood(const std::vector<take::TakeMesh>& meshes);

/// Makes scenes of the frames of one take. Fruit: all with the same camera, the fresh fruit (several: the
/// first of the `framed_by` frames, since they lie there as they settled) fills the picture, so that later
/// frames show how it shrank, and each frame rests with its lowest point on the floor. Wood: the camera sees
/// a region that holds the `framed_by` frames, and the floor is at their lowest point.
class Stage {
  public:
    /// Throws InputError when there is no mesh with vertices. `framed_by` is for wood and for several fruit;
    /// empty: the rest shapes.
    Stage(const std::vector<take::TakeMesh>& meshes, const StageSettings& settings,
          std::span<const take::Frame> framed_by = {});

    /// Throws InputError when the frame's meshes are not those of the take.
    Scene scene_of(const take::Frame& frame) const;

    /// Turns the camera of a scene of this stage, and the lights with it, to another direction. View and
    /// framing are for wood.
    void aim(Scene& scene, double azimuth_deg, double elevation_deg, View view, Framing framing) const;

  private:
    void frame_fruit(const std::vector<take::TakeMesh>& meshes, std::span<const take::Frame> framed_by);
    void frame_wood(const std::vector<take::TakeMesh>& meshes, std::span<const take::Frame> framed_by);
    Scene fruit_scene(const take::Frame& frame) const;
    Scene wood_scene(const take::Frame& frame) const;

    StageSettings m_settings;
    std::vector<FruitSurface> m_fruit;        // of a take of fruit
    std::vector<take::TakeMesh> m_furniture;  // what the fruit lies in or on
    std::vector<take::TakeMesh> m_wood;       // of a take of wood
    Eigen::Matrix3f m_pose = Eigen::Matrix3f::Identity();
    Vec3f m_centre = Vec3f::Zero();  // of the sphere about the posed fresh fruit, which rests on the floor
    double m_radius = 1;             // of that sphere
    Region m_whole, m_break;
};

}  // namespace windfall::picture
