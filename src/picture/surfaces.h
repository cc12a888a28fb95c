#pragma once
// The meshes and the hair of a scene, ready for rays (Embree).
#include <memory>
#include <optional>

#include "picture/scene.h"

namespace windfall::picture {

struct Ray {
    Vec3f origin, direction;
    float from = 0;
    float to = 1e30F;
};

struct SurfacePoint {
    float distance = 0;
    Vec3f place;
    Vec3f face_normal;  ///< of the facet, on the side of the outside
    Vec3f normal;       ///< interpolated
    Vec3f albedo;
    const Finish* finish = nullptr;
    float roughness = 0.4F, gloss = 1;       ///< of the finish, or of the texture
    Vec3f scatter = Vec3f::Zero();           ///< likewise
    float pores = 1;                         ///< share of the finish's pores that is not covered
    const SceneMesh* mesh = nullptr;         ///< null on hair
    std::array<std::uint32_t, 3> corners{};  ///< of the triangle that was hit
    std::array<float, 3> weights{};
    std::array<Eigen::Vector2f, 3> corner_uvs{};   ///< where the mesh has a texture
    Eigen::Vector2f uv = Eigen::Vector2f::Zero();  ///< likewise
    Vec3f start;  ///< where rays leave from: lifted off the facet towards the smooth surface
};

/// Read-only once built; may be used from several threads. The scene must outlive it.
class Surfaces {
  public:
    /// Throws RunError when Embree fails.
    explicit Surfaces(const Scene& scene);
    ~Surfaces();
    Surfaces(const Surfaces&) = delete;
    Surfaces& operator=(const Surfaces&) = delete;

    std::optional<SurfacePoint> first_hit(const Ray& ray) const;
    /// By a mesh; hair lets light through.
    bool blocked(const Ray& ray) const;

  private:
    struct Handles;
    const Scene& m_scene;
    std::unique_ptr<Handles> m_handles;
    bool misses_bounds(const Ray& ray) const;

    Vec3f m_low, m_high;  // box about all surfaces
    float m_lift = 0;     // how far rays start off a facet
};

}  // namespace windfall::picture
