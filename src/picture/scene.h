#pragma once
// What is rendered: surfaces with a colour per vertex on a studio floor, under lights far away.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace windfall::picture {

using Vec3f = Eigen::Vector3f;

/// Brightness of a linear colour as the eye weighs it (Rec. 709).
inline float luminance(const Vec3f& c) { return 0.2126F * c.x() + 0.7152F * c.y() + 0.0722F * c.z(); }

/// Fine structure that the light sees and the mesh does not have (grain.h).
enum class Grain { None, Bark, Fibres, EndGrain, Peel };

/// How a part of a surface reflects light.
struct Finish {
    float roughness = 0.4F;  ///< of the clear coat: GGX, alpha = roughness squared
    float gloss = 1;         ///< weight of the clear coat (F0 0.04); 0: none
    Vec3f scatter =
        Vec3f::Zero();  ///< mean path of light under the surface, per colour, in units of the scene; 0: none
    Grain grain = Grain::None;
    float pore_size = 1;   ///< of Grain::Peel, in units of the rest shape
    float pore_depth = 1;  ///< of Grain::Peel, relative to an orange's
    bool hard = false;     ///< shaded with the normals of the facets, so that its edges are crisp
};

struct SurfaceTexture;  // texture_lookup.h

/// A surface fine enough to be drawn with its facets: quadrilaterals with normals and colours at the
/// vertices.
struct SceneMesh {
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals;                       ///< unit length, outwards
    std::vector<Vec3f> albedo;                        ///< linear RGB, 0..1
    std::vector<Vec3f> rest;                          ///< where a grain sticks to; empty where there is none
    std::vector<std::array<std::uint32_t, 4>> quads;  ///< a triangle repeats its last corner
    std::vector<Finish> finishes{Finish{}};           ///< at least one
    std::vector<std::uint8_t> quad_finishes;          ///< of each quad; empty: all have the first
    std::shared_ptr<const SurfaceTexture>
        texture;  ///< in place of `albedo` and of parts of the finish; or null
    std::vector<std::array<Eigen::Vector2f, 4>> quad_uvs;  ///< of each quad where there is a texture
};

/// Strands so thin that they are drawn as lines with a thickness: mold.
struct SceneHair {
    int points_per_strand = 2;
    std::vector<Vec3f> points;   ///< points_per_strand of each strand, from the root on
    std::vector<float> radii;    ///< of each strand
    std::vector<Vec3f> colours;  ///< of each strand, linear
};

/// Twice the area of a facet, along its normal.
inline Vec3f facet_area(const std::vector<Vec3f>& positions, const std::array<std::uint32_t, 4>& quad) {
    return (positions[quad[2]] - positions[quad[0]]).cross(positions[quad[3]] - positions[quad[1]]);
}

/// A round light so far away that it is the same everywhere, seen as a disc of even brightness.
struct DistantLight {
    Vec3f direction = Vec3f::UnitY();  ///< towards the light, unit length
    float angular_radius_deg = 15;
    Vec3f irradiance = Vec3f::Ones();  ///< on a plane that faces it
};

/// Light from all around: a gradient with the sine of the elevation.
struct Sky {
    Vec3f zenith = Vec3f::Ones();
    Vec3f horizon = Vec3f::Ones();
    Vec3f nadir = Vec3f::Ones();
    Vec3f radiance(const Vec3f& direction) const;
};

/// The floor reflects like grey paper; the camera sees the backdrop in its place, darkened by the shadows on
/// it, so that there is no horizon.
struct Floor {
    float height = 0;
    Vec3f albedo = Vec3f::Constant(0.6F);
};

/// Looks at `target` from an orbit; y is up.
struct Camera {
    Vec3f target = Vec3f::Zero();
    double azimuth_deg = 25;
    double elevation_deg = 22;
    double distance = 5;
    double vertical_field_of_view_deg = 24;
};

/// Room about what a picture shows; 1: it touches the frame.
inline constexpr double kFramingMargin = 1.12;

/// The camera that sees the whole of a sphere with `margin`.
Camera frame_sphere(const Vec3f& centre, double radius, double azimuth_deg, double elevation_deg,
                    double margin = kFramingMargin);

/// What a picture is to show: points that stand for a whole surface.
struct Region {
    Vec3f centre = Vec3f::Zero();  ///< of the box about it
    float half_height = 1;         ///< of that box
    std::vector<Vec3f> points;
};

/// Whether a camera keeps its distance and height when it goes around, so that a turntable does not wobble,
/// or comes as near as one side lets it.
enum class Framing { AllSides, OneSide };

/// The camera that sees the whole of a region with `margin`.
Camera frame_region(const Region& region, double azimuth_deg, double elevation_deg, Framing framing,
                    double margin = 1.06);

struct Scene {
    std::vector<SceneMesh> meshes;
    std::vector<SceneHair> hair;
    std::vector<DistantLight> lights;
    Sky sky;
    bool has_floor = true;
    Floor floor;
    Vec3f backdrop_top =
        Vec3f::Constant(0.8F);  ///< what the camera sees behind all, from the top of the picture
    Vec3f backdrop_bottom = Vec3f::Constant(0.8F);
    Camera camera;
};

}  // namespace windfall::picture
