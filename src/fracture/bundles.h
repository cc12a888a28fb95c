#pragma once
// Fibre bundles: the cross-section cut into irregular polar bricks, level by level from coarse to fine. They
// are defined without the lattice, so that a break is the same one at any resolution.
#include <cstdint>
#include <vector>

#include "fracture/bending.h"
#include "fracture/parameters.h"

namespace windfall::fracture {

/// One bundle breaks at its own height on its own tilted plane: z = height + slope_x x + slope_y y.
struct Bundle {
    float height = 0, slope_x = 0, slope_y = 0;
    float centre_x = 0, centre_y = 0;
    std::uint32_t name = 0;  ///< hash, the same at any resolution
};

/// Size and relief of one level.
struct BundleLevel {
    float radial, angular, amplitude, slope, skew;
};

/// The bricks of one level. Rings of bricks ("bands") and the bricks in a band begin at the points of a
/// golden-ratio sequence k phi mod 1: one brick more splits one of the others in two and leaves all else in
/// place, where an even subdivision would move every one. While it is new it takes after the one that it was
/// split from, so that a slider moves the break without a jump.
class BundleTable {
  public:
    /// Lays out the bricks; heights are drawn when a bundle is first asked for.
    void reset(std::uint32_t seed, std::uint32_t level_index, const BundleLevel& level,
               const TensionField& tension);

    /// The bundle at (radius, angle), radius 0 .. 1.4, angle 0 .. 2 pi. The reference is good until `reset`.
    const Bundle& at(float radius, float angle) { return bundle(index_at(radius, angle)); }
    std::size_t index_at(float radius, float angle);
    const Bundle& bundle(std::size_t index) {
        if (m_drawn[index] != m_draw) draw(index);
        return m_bundles[index];
    }
    std::size_t size() const { return m_starts.size(); }

  private:
    struct Band {
        float low, high;     // radii
        float phase;         // of its first brick, in turns
        float newest;        // weight of its last brick in the golden sequence, 0 .. 1
        std::uint32_t name;  // its index in the golden sequence of bands
        std::uint32_t first, count;
        std::uint32_t bucket_first;
    };
    void lay_out(float radial, float angular);
    void fill_band(Band& band, std::uint32_t count);
    void draw(std::size_t index);
    Bundle plane_of(const Band& band, std::size_t index, float start, float end) const;

    std::uint32_t m_seed = 0, m_level = 0;
    BundleLevel m_shape{};
    TensionField m_tension{};
    std::vector<float> m_golden;             // the golden sequence as far as it was needed
    std::vector<Band> m_bands;               // from the pith out
    std::vector<std::uint8_t> m_band_start;  // by radius bucket: the innermost band that reaches into it
    std::vector<float> m_starts;             // of the bricks, in turns; sorted within a band
    std::vector<std::uint32_t> m_names;      // index in the golden sequence of each brick
    std::vector<std::uint32_t> m_band_of;
    std::vector<std::uint32_t> m_buckets;  // by angle: the brick in which the bucket begins
    std::vector<Bundle> m_bundles;
    std::vector<std::uint32_t> m_drawn;
    std::uint32_t m_draw = 0;
    std::size_t m_last = 0;  // what was asked for last: a neighbour mostly wants it again, or the next one
};

}  // namespace windfall::fracture
