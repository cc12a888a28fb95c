#include "fracture/bundles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/angles.h"
#include "fracture/noise.h"

namespace windfall::fracture {
namespace {

constexpr double kGolden = 0.6180339887498949;
// The domain warp carries points beyond the bark.
constexpr float kOuterRadius = 1.45F;
constexpr std::size_t kRadiusBuckets = 256;
constexpr std::size_t kMostBands = 250;

float golden_point(std::uint32_t k) {
    const double x = k * kGolden;
    return static_cast<float>(x - std::floor(x));
}

/// Cosine and sine of an angle in turns, to 4e-7, without the library's reduction of large ones.
inline std::pair<float, float> on_unit_circle(float turns) {
    const float quarter = std::nearbyint(4 * turns);
    const float x = (4 * turns - quarter) * (kTwoPi<float> / 4), x2 = x * x;
    const float sine = x * (1 + x2 * (-1.0F / 6 + x2 * (1.0F / 120 - x2 / 5040)));
    const float cosine = 1 + x2 * (-0.5F + x2 * (1.0F / 24 + x2 * (-1.0F / 720 + x2 / 40320)));
    const auto quadrant = static_cast<std::uint32_t>(static_cast<std::int32_t>(quarter));
    const bool swapped = (quadrant & 1U) != 0;
    const float c = swapped ? sine : cosine, s = swapped ? cosine : sine;
    return {((quadrant + 1) & 2U) != 0 ? -c : c, (quadrant & 2U) != 0 ? -s : s};
}

std::size_t radius_bucket(float radius) {
    return std::min(kRadiusBuckets - 1, static_cast<std::size_t>(radius * (kRadiusBuckets / kOuterRadius)));
}

}  // namespace

void BundleTable::reset(std::uint32_t seed, std::uint32_t level_index, const BundleLevel& level,
                        const TensionField& tension) {
    m_seed = seed;
    m_level = level_index;
    m_shape = level;
    m_tension = tension;
    lay_out(level.radial, level.angular);
    m_bundles.resize(m_starts.size());
    m_drawn.resize(m_starts.size(), 0);
    m_last = 0;
    if (++m_draw == 0) {
        std::fill(m_drawn.begin(), m_drawn.end(), 0U);
        m_draw = 1;
    }
}

void BundleTable::lay_out(float radial, float angular) {
    const auto bands =
        static_cast<std::uint32_t>(std::clamp(std::ceil(kOuterRadius / radial), 1.0F, float(kMostBands)));
    std::vector<std::pair<float, std::uint32_t>> edges;
    for (std::uint32_t k = 0; k < bands; ++k) edges.emplace_back(kOuterRadius * golden_point(k), k);
    std::sort(edges.begin(), edges.end());

    m_bands.clear();
    m_starts.clear();
    m_names.clear();
    m_band_of.clear();
    m_buckets.clear();
    for (std::uint32_t b = 0; b < bands; ++b) {
        const float low = edges[b].first;
        const float high = b + 1 < bands ? edges[b + 1].first : 2 * kOuterRadius;
        const std::uint32_t name = edges[b].second;
        // The golden sequence makes bands of two widths; a wider band has longer bricks, as wood has.
        const float middle = 0.5F * (low + std::min(high, kOuterRadius));
        const float spread = 0.75F + 0.5F * random_unit(m_seed, NoisePurpose::BandOffset, name, 1, m_level);
        const float bricks = std::max(1.0F, kTwoPi<float> * middle / angular * spread);
        const float count = std::ceil(bricks);
        const float phase = random_unit(m_seed, NoisePurpose::BandOffset, name, 0, m_level);
        Band band{low, high, phase, bricks - count + 1, name, 0, 0, 0};
        fill_band(band, static_cast<std::uint32_t>(count));
        m_bands.push_back(band);
    }
    m_band_start.assign(kRadiusBuckets, 0);
    for (std::size_t i = 0, b = 0; i < kRadiusBuckets; ++i) {
        const float radius = static_cast<float>(i) * (kOuterRadius / kRadiusBuckets);
        while (m_bands[b].high <= radius) ++b;
        m_band_start[i] = static_cast<std::uint8_t>(b);
    }
}

void BundleTable::fill_band(Band& band, std::uint32_t count) {
    band.first = static_cast<std::uint32_t>(m_starts.size());
    band.count = count;
    band.bucket_first = static_cast<std::uint32_t>(m_buckets.size());
    m_starts.resize(band.first + count);
    m_names.resize(band.first + count);
    m_band_of.resize(band.first + count, static_cast<std::uint32_t>(m_bands.size()));
    m_buckets.resize(band.bucket_first + count + 1);

    while (m_golden.size() <= count)
        m_golden.push_back(golden_point(static_cast<std::uint32_t>(m_golden.size())));
    const float* points = m_golden.data();
    float* starts = m_starts.data() + band.first;
    std::uint32_t* names = m_names.data() + band.first;
    std::uint32_t* buckets = m_buckets.data() + band.bucket_first;
    // The points of a golden sequence follow one another by three steps of their indices (Sos 1958): with
    // those of the lowest point above 0 and of the highest one.
    std::uint32_t low = 1, high = 1;
    while (low + high < count) (points[low + high] < points[low] ? low : high) = low + high;
    const auto scale = static_cast<float>(count);
    std::uint32_t bucket = 0;
    for (std::uint32_t i = 0, k = 0; i < count; ++i) {
        starts[i] = points[k];
        names[i] = k;
        const auto own = static_cast<std::uint32_t>(points[k] * scale);
        while (bucket <= own) buckets[bucket++] = i;
        if (k + low < count)
            k += low;
        else
            k = k >= high ? k - high : k + low - high;
    }
    while (bucket <= count) buckets[bucket++] = count;
}

std::size_t BundleTable::index_at(float radius, float angle) {
    const Band* band = &m_bands[m_band_of[m_last]];
    const bool same_band = radius >= band->low && radius < band->high;
    if (!same_band) {
        std::size_t b = m_band_start[radius_bucket(radius)];
        while (radius >= m_bands[b].high && b + 1 < m_bands.size()) ++b;
        band = &m_bands[b];
    }
    float turn = angle * (1 / kTwoPi<float>)+band->phase;
    if (turn >= 1) turn -= 1;
    turn = std::clamp(turn, 0.0F, 0.99999994F);
    const float* starts = m_starts.data() + band->first;
    const auto end_of = [&](std::uint32_t i) { return i + 1 < band->count ? starts[i + 1] : 1.0F; };
    auto i = static_cast<std::uint32_t>(m_last) - band->first;
    if (!same_band || turn < starts[i] || turn >= end_of(i)) {
        const auto bucket =
            std::min(band->count - 1, static_cast<std::uint32_t>(turn * static_cast<float>(band->count)));
        // The first brick starts at turn 0, so that there is always one at or before the place.
        i = std::min(m_buckets[band->bucket_first + bucket], band->count - 1);
        while (i > 0 && starts[i] > turn) --i;
        while (turn >= end_of(i)) ++i;
    }
    return m_last = band->first + i;
}

/// The plane of a brick between two angles, in turns.
Bundle BundleTable::plane_of(const Band& band, std::size_t index, float start, float end) const {
    const auto [out_x, out_y] = on_unit_circle(0.5F * (start + end) - band.phase);
    const float radius = 0.5F * (band.low + std::min(band.high, kOuterRadius));
    Bundle bundle;
    bundle.centre_x = radius * out_x;
    bundle.centre_y = radius * out_y;
    const auto random = [&](NoisePurpose purpose) {
        return random_unit(m_seed, purpose, band.name, m_names[index], m_level);
    };
    const float weight = m_tension.weight(bundle.centre_x, bundle.centre_y);
    const float tallness =
        std::pow(random(NoisePurpose::BundleHeight), m_shape.skew) - 1 / (m_shape.skew + 1);
    const auto [down_x, down_y] = on_unit_circle(random(NoisePurpose::BundleDirection));
    const float slope = m_shape.slope * weight * (0.3F + 0.9F * random(NoisePurpose::BundleSlope));
    bundle.slope_x = slope * down_x;
    bundle.slope_y = slope * down_y;
    bundle.height = m_shape.amplitude * weight * tallness - bundle.slope_x * bundle.centre_x -
                    bundle.slope_y * bundle.centre_y;
    bundle.name = noise_key(m_seed, NoisePurpose::BundleName, band.name, m_names[index], m_level);
    return bundle;
}

void BundleTable::draw(std::size_t index) {
    const Band& band = m_bands[m_band_of[index]];
    const std::size_t k = index - band.first;
    const float* starts = m_starts.data() + band.first;
    const auto end_of = [&](std::size_t i) { return i + 1 < band.count ? starts[i + 1] : 1.0F; };
    const auto newest = [&](std::size_t i) {
        return band.count > 1 && m_names[band.first + i] == band.count - 1;
    };
    Bundle& bundle = m_bundles[index];
    if (k + 1 < band.count && newest(k + 1)) {
        const float before = end_of(k + 1);  // its end before the newest brick was split off
        bundle = plane_of(band, index, starts[k], before + band.newest * (starts[k + 1] - before));
    } else if (newest(k)) {
        const Bundle own = plane_of(band, index, starts[k], end_of(k));
        const Bundle& old = this->bundle(index - 1);
        const auto mixed = [&](float a, float b) { return a + band.newest * (b - a); };
        bundle = {mixed(old.height, own.height),     mixed(old.slope_x, own.slope_x),
                  mixed(old.slope_y, own.slope_y),   mixed(old.centre_x, own.centre_x),
                  mixed(old.centre_y, own.centre_y), own.name};
    } else {
        bundle = plane_of(band, index, starts[k], end_of(k));
    }
    m_drawn[index] = m_draw;
}

}  // namespace windfall::fracture
