#pragma once
// One fruit as a body: soft flesh that shrinks and sinks, and a skin that follows it and wrinkles.
// Quasi-static: a frame is a step towards equilibrium under the load of that frame.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/run_context.h"
#include "decay/body_ground.h"
#include "geometry/surface_mesh.h"

namespace windfall::decay {

/// Surface of a fruit: the point (m, z up) for a unit direction.
using SurfaceFunction = std::function<geometry::Vec3(const geometry::Vec3& direction)>;

/// Inside of a fruit: the point (m) for a unit direction and a fraction of the way from the centre (0: the
/// same point for all directions) to the surface (1).
using InteriorFunction = std::function<geometry::Vec3(const geometry::Vec3& direction, double fraction)>;

struct BodySettings {
    double mass_kg = 0.123;   ///< fresh
    double firmness = 50;     ///< 1..100; modulus of the fresh flesh 2 kPa * 2000^(firmness / 100)
    double thickness = 20;    ///< 1..100; skin 0.05 mm + 3 mm (thickness / 100)^2
    double softening = 0.25;  ///< modulus of the flesh at progress 1 over the fresh one, in (0, 1]
    double skin_modulus_pa = 10e6;
    double rot_shrinkage = 0.35;  ///< share of its length that thoroughly rotten flesh loses
    double rot_softening = 20;    ///< modulus of sound flesh over that of thoroughly rotten flesh
    double rot_depth_m = 0.010;   ///< depth at which rot's effect has fallen to 1/e
    double wave_length_m = 0;     ///< of the wrinkles; 0: from thickness and moduli
    int skin_cells = 41;          ///< per edge of the cube: 6 n^2 + 2 vertices
    int flesh_cells = 10;
    int flesh_layers = 6;  ///< of nodes, from the surface in; one more node is the centre
    std::uint64_t seed = 1;
};

/// What a frame asks of a body.
struct BodyLoad {
    double water_fraction_lost = 0;   ///< volume of the water lost over the fresh volume, 0..0.95
    double progress = 0;              ///< 0 fresh .. 1 as soft as it gets
    std::span<const float> rot = {};  ///< per skin vertex 0..1; empty: sound
    double gravity_m_s2 = 9.81;
};

/// Owns flesh and skin of one fruit. Not to be used from two threads at once; uses the house's parallel loops
/// inside, with the same bits on any number of threads.
class Body {
  public:
    /// Throws InputError for settings out of range and for surfaces whose flesh would be inside out.
    Body(const SurfaceFunction& surface, const BodySettings& settings, const InteriorFunction& interior = {});
    Body(const Body&) = delete;
    Body& operator=(const Body&) = delete;
    Body(Body&&) noexcept;
    Body& operator=(Body&&) noexcept;
    ~Body();

    /// Lowers the fruit to the table z = 0 and lets it come to rest there under its own weight.
    void settle(const RunContext& run);

    /// One frame. Needs `settle` (or a settled BodyPile) before. Throws InputError for a load out of range
    /// and RunError when positions are no longer finite.
    void advance(const BodyLoad& load);

    /// Skin vertices (m), in the order of geometry::make_brick_surface({n, n, n}) with n = skin_cells.
    const std::vector<Eigen::Vector3f>& skin() const;
    /// The flesh's surface under each skin vertex: the skin's thickness below it.
    const std::vector<Eigen::Vector3f>& flesh() const;
    /// The skin at rest: settled, before any loss.
    const std::vector<Eigen::Vector3f>& rest() const;
    /// Unit direction of each skin vertex: what the surface function was asked for.
    const std::vector<geometry::Vec3>& directions() const;
    const std::vector<geometry::Face>& faces() const;

    double volume_m3() const;  ///< inside the skin
    double area_m2() const;    ///< of the skin
    double height_m() const;   ///< of the skin, highest less lowest
    double lowest_m() const;
    double skin_thickness_m() const;
    double wave_length_m() const;  ///< that the skin was given
    /// Tetrahedra of the flesh that are inside out.
    int inverted() const;
    /// Edges of the skin that pierce one of its faces.
    int crossing_edges() const;
    /// Skin vertices within `gap_m` of the ground, or of another fruit when in a pile.
    std::vector<std::int32_t> touching(double gap_m = 1.5e-3) const;

    /// State from which `restore` on a body of the same surface and settings goes on to the same bits.
    std::vector<std::byte> save() const;
    /// Throws InputError for a state of another body or version.
    void restore(std::span<const std::byte> state);

  private:
    friend class BodyPile;
    struct Parts;
    std::unique_ptr<Parts> m_parts;
};

}  // namespace windfall::decay
