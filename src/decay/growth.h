#pragma once
// Soft rot, fungi and nutrient on a closed skin: Kider, Raja, Badler 2011, eqs. (2)-(9), on the texels of an
// atlas with the metric of the surface.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "decay/growth_settings.h"
#include "geometry/cube_atlas.h"

namespace windfall::decay {

/// The state of all organisms on one skin and the way to move it forward in time. Arrays have one value a
/// texel of the atlas, 0 in its gutters. The same seed and calls give the same bits on any number of threads.
/// One thread at a time may call it; it uses several itself.
class Growth {
  public:
    /// `texel_positions_m`: the surface point of every covered texel's centre (others are not read).
    /// Throws InputError for wrong settings or sizes, a fungus without a soft rot, more than one soft rot, or
    /// a surface with texels of no area.
    Growth(const geometry::CubeAtlas& atlas, std::span<const geometry::Vec3> texel_positions_m,
           const std::vector<Organism>& organisms, const GrowthSettings& settings, std::uint64_t seed,
           const GrowthFields& fields = {});
    ~Growth();
    Growth(Growth&&) noexcept;
    Growth& operator=(Growth&&) noexcept;
    Growth(const Growth&) = delete;
    Growth& operator=(const Growth&) = delete;

    /// Moves on by `hours`.
    void advance(double hours, const GrowthConditions& conditions);

    /// Puts active organism with the given peak density (0..1; the density there already is kept where it is
    /// higher) into a smooth spot about a texel; for a fungus only where the gate is open. The amount comes
    /// from outside: `total` grows by it. Returns that growth.
    double plant(std::size_t organism, std::size_t texel, double radius_m, double density);

    /// Texels that a walk over the surface from `texel` reaches without leaving the ball of that radius about
    /// it, in rising order: the surface's disc, for radii small against its curvature.
    std::vector<std::size_t> disc(std::size_t texel, double radius_m) const;
    /// The covered texel nearest to a point.
    std::size_t nearest_texel(const geometry::Vec3& point_m) const;

    std::size_t organism_count() const;
    const Organism& organism(std::size_t o) const;
    std::size_t texel_count() const;
    /// Density of the active and inactive organism; their sum is what is seen.
    std::span<const float> active(std::size_t o) const;
    std::span<const float> inactive(std::size_t o) const;
    std::span<const float> nutrient() const;
    /// 0 where soft rot has never been .. 1 where fungus grows freely.
    std::span<const float> gate() const;
    /// Area of each texel in m2; 0 in the gutters.
    std::span<const float> areas_m2() const;
    std::span<const geometry::Vec3> positions_m() const;

    /// Integral over the skin in m2 of all densities and the nutrient; constant but for what is planted.
    double total() const;
    /// Area in m2 where active + inactive >= threshold.
    double area_over(std::size_t o, double threshold) const;

    double time_h() const;
    /// Steps taken, and passes over the active skin that they took.
    std::uint64_t step_count() const;
    std::uint64_t pass_count() const;
    /// Share of the skin's tiles in which an organism is at work, 0..1.
    double active_share() const;

    /// The state as bytes; restoring it into a Growth made with the same arguments goes on to the same bits.
    std::vector<std::byte> save() const;
    /// Throws InputError when the bytes are not of such a Growth.
    void restore(std::span<const std::byte> state);

  private:
    struct State;
    std::unique_ptr<State> m_state;
};

}  // namespace windfall::decay
