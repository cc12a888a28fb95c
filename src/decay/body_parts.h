#pragma once
// What a Body is made of; for the body and for piles of them.
#include <vector>

#include "decay/body.h"
#include "decay/body_embedding.h"
#include "decay/body_material.h"
#include "decay/flesh_solver.h"
#include "decay/skin.h"
#include "decay/tetrahedra.h"

namespace windfall::decay {

/// Planes of the nearest other fruit, per node of the flesh's surface and per skin vertex; empty for a fruit
/// that stands alone.
struct BodyNeighbours {
    std::vector<ContactPlane> flesh, skin;
};

struct Body::Parts {
    Parts(const SurfaceFunction& surface, const BodySettings& body_settings,
          const InteriorFunction& interior);

    /// A step of settling: `ramp` of the weight.
    void settle_step(double gravity_m_s2);
    /// The skin laid onto the settled flesh.
    void finish_settling();
    void advance(const BodyLoad& load);
    void translate(const Eigen::Vector3f& by_m);

    BodySettings settings;
    geometry::BrickSurface skin_brick;
    std::vector<geometry::Vec3> directions;
    std::vector<geometry::Vec3> fresh;  ///< skin vertices
    std::vector<geometry::Face> faces;
    FleshMesh mesh;
    double fresh_volume_m3 = 0;
    double density_kg_m3 = 0;
    FleshMaterial material;
    FleshSolver solver;
    BodyEmbedding embedding;
    Skin skin;
    SkinMaterial skin_material;
    Ground ground = table_ground();
    BodyNeighbours neighbours;
    std::vector<Eigen::Vector3f> target;  ///< of the skin: the flesh's surface at the skin's vertices
    std::vector<Eigen::Vector3f> rest, flesh;

    template <class Archive>
    void serialise(Archive& archive) {
        solver.serialise(archive);
        skin.serialise(archive);
        archive(rest);
        archive(target);
    }

    void find_flesh();

  private:
    void flesh_frame(double gravity_m_s2, int least_steps, int most_steps);
    std::vector<ContactPlane> ground_planes(const std::vector<Eigen::Vector3f>& points) const;
    std::vector<Eigen::Vector3f> flesh_surface_points() const;
    std::vector<Eigen::Matrix3f> m_gradients;
};

}  // namespace windfall::decay
