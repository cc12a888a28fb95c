#pragma once
// Puts a frame of a take into the studio: pose, floor, lights, colours.
#include <memory>
#include <vector>

#include "picture/colouring.h"
#include "picture/look.h"
#include "picture/refinement.h"
#include "picture/scene.h"
#include "take/frame.h"

namespace windfall::picture {

struct StageSettings {
    Look look;
    Colouring colouring = Colouring::Material;
    double azimuth_deg = 25;
    double elevation_deg = 22;
    int picture_size = 480;         ///< pixels; decides how finely the surfaces are refined
    double final_shrinkage = 0;     ///< shrinkage at which the skin has its dry colour; 0: it stays fresh
    double false_colour_scale = 1;  ///< curvature (1/length) or depth at which the false colours are full
};

/// The values that a colouring shows at the vertices of a mesh: mean curvature, or the attribute "depth" with
/// its sign turned, so that ridges are positive as they are in curvature. Empty for the material. Throws
/// InputError when the mesh has no such attribute.
std::vector<double> shown_values(Colouring colouring, const take::TakeMesh& mesh,
                                 const take::FrameMesh& moved);

/// Makes scenes of the frames of one take, all with the same camera: the fresh fruit fills the picture, so
/// that later frames show how it shrank. Each frame rests with its lowest point on the floor.
class Stage {
  public:
    /// Throws InputError when there is no mesh with vertices.
    Stage(const std::vector<take::TakeMesh>& meshes, const StageSettings& settings);

    /// Throws InputError when the frame's meshes are not those of the take.
    Scene scene_of(const take::Frame& frame) const;

    /// Turns the camera of a scene of this stage, and the lights with it, to another azimuth.
    void aim(Scene& scene, double azimuth_deg) const;

  private:
    struct Part {
        take::TakeMesh mesh;
        Refinement refinement;
    };
    SceneMesh mesh_of(const Part& part, const take::FrameMesh& moved, double dryness) const;

    StageSettings m_settings;
    std::vector<Part> m_parts;
    Eigen::Matrix3f m_pose;
    Vec3f m_centre;       // of the sphere about the posed fresh fruit, which rests on the floor at height 0
    double m_radius = 1;  // of that sphere
};

}  // namespace windfall::picture
