#include "fracture/wood_colour.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "fracture/noise.h"
#include "fracture/wood_palette.h"

namespace windfall::fracture {
namespace {

/// One noise of colours each; told apart by the purpose's index.
enum class ColourNoise : std::uint32_t {
    RingX,
    RingY,
    RingWidth,
    Ray,
    Bundle,
    Streak,
    Patch,
    BarkPatch,
    InnerBark
};

float linear_part(float srgb) {
    return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
}
Vector3f linear_rgb(const Vector3f& srgb) {
    return {linear_part(srgb.x()), linear_part(srgb.y()), linear_part(srgb.z())};
}

Vector3f colour_mix(const Vector3f& a, const Vector3f& b, float t) { return a + t * (b - a); }

float luminance_of(const Vector3f& c) { return 0.2126F * c.x() + 0.7152F * c.y() + 0.0722F * c.z(); }

/// All that the colours depend on, ready for many vertices.
class WoodPainter {
  public:
    explicit WoodPainter(const FractureParameters& parameters) : m_palette(palette_of(parameters)) {
        const std::uint32_t seed = noise_seed(parameters.seed);
        for (std::uint32_t i = 0; i < m_keys.size(); ++i)
            m_keys[i] = noise_key(seed, NoisePurpose::Colour, 0, 0, i);
        m_pith = linear_rgb(m_palette.pith);
        m_heartwood = linear_rgb(m_palette.heartwood);
        m_sapwood = linear_rgb(m_palette.sapwood);
        m_inner_bark = linear_rgb(m_palette.inner_bark);
        m_bark = linear_rgb(m_palette.bark);
        m_weathering = static_cast<float>(parameters.colours.weathering);
        if (parameters.species.moisture == Moisture::Wet)
            m_wetness = static_cast<float>(parameters.colours.wetness);
    }

    Vector3f colour(const Vector3f& place, Tissue tissue, float thorn, std::uint32_t bundle) const {
        const float radius = std::hypot(place.x(), place.y());
        Vector3f result = tissue == Tissue::Bark     ? bark(place, radius)
                          : tissue == Tissue::Phloem ? inner_bark(place, radius)
                                                     : wood(place, radius, tissue);
        if (tissue != Tissue::Bark) {
            const float own = 2 * unit_float(mixed_bits(bundle ^ key(ColourNoise::Bundle))) - 1;
            const float hue = 2 * unit_float(mixed_bits(bundle + key(ColourNoise::Bundle))) - 1;
            const float streak = noise(ColourNoise::Streak, 24 * place.x() + 0.35F * place.z(),
                                       24 * place.y() - 0.27F * place.z());
            result *= std::max(0.2F, 1 + m_palette.variation * own + m_palette.streaks * streak);
            result.x() *= 1 + 0.25F * m_palette.variation * hue;  // redder or yellower
            result.z() *= 1 - 0.35F * m_palette.variation * hue;
            result = colour_mix(result, colour_mix(result, Vector3f::Ones(), 0.35F),
                                std::clamp(thorn, 0.0F, 1.0F));
        }
        return finished(result).cwiseMax(0.0F).cwiseMin(1.0F);
    }

  private:
    std::uint32_t key(ColourNoise which) const { return m_keys[static_cast<std::size_t>(which)]; }
    float noise(ColourNoise which, float x, float y) const { return gradient_noise(key(which), x, y); }

    Vector3f wood(const Vector3f& p, float radius, Tissue tissue) const {
        // A tree's rings are not circles, and its heartwood does not keep to them.
        const float wandering =
            0.025F * noise(ColourNoise::RingX, 1.7F * p.x(), 1.7F * p.y()) +
            0.008F * noise(ColourNoise::RingY, 6 * p.x() + 0.2F * p.z(), 6 * p.y() - 0.1F * p.z());
        const float ring_radius = radius + wandering * std::min(1.0F, 4 * radius);
        const auto border = static_cast<float>(m_palette.tissue.pith + m_palette.tissue.heartwood);
        const float to_sapwood = smooth_step(border - 0.02F, border + 0.02F, ring_radius);
        Vector3f result = tissue == Tissue::Pith ? m_pith : colour_mix(m_heartwood, m_sapwood, to_sapwood);
        result *= 1 - m_palette.late_wood * darkness(ring_radius);
        if (radius > 1e-3F) {
            // seen from above a ray is a line from the pith out; about the circle it is noise of one
            // dimension
            const float ray =
                noise(ColourNoise::Ray, 13 * p.x() / radius + 1.5F * radius, 13 * p.y() / radius);
            result *= 1 + m_palette.rays * smooth_step(0.2F, 0.55F, ray);
        }
        result *= 1 + 0.1F * noise(ColourNoise::Patch, 1.5F * p.x() + 0.3F * p.z(), 1.5F * p.y());
        return result;
    }

    /// 0 between the rings, 1 in their dark part.
    float darkness(float ring_radius) const {
        // Good years and bad ones: the width varies by a third.
        const float years = ring_radius / m_palette.ring_width;
        const float phase = years + 0.35F * noise(ColourNoise::RingWidth, 0.83F * years, 0.5F);
        const float part = phase - std::floor(phase);
        switch (m_palette.rings) {
            case RingKind::LateWood:
                return smooth_step(0.45F, 0.92F, part) * (1 - smooth_step(0.96F, 1, part));
            case RingKind::RingPorous:
                return 1 - smooth_step(0.04F, 0.38F, part);
            case RingKind::DiffusePorous:
                return smooth_step(0.8F, 0.95F, part) * (1 - smooth_step(0.95F, 1, part));
        }
        return 0;
    }

    Vector3f inner_bark(const Vector3f& p, float radius) const {
        const float patches = noise(ColourNoise::InnerBark, 11 * p.x() + 0.8F * p.z(), 11 * p.y() - p.z());
        Vector3f result = m_inner_bark * (1 + 0.25F * patches);
        if (m_wetness > 0) {
            // the cambium, on the wood's side, is green and grows pale towards the bark
            const auto width = static_cast<float>(std::max(0.02, m_palette.tissue.phloem));
            const float from_wood = std::clamp((radius - (1 - width)) / width, 0.0F, 1.0F);
            const float green = std::min(1.0F, 0.75F * m_wetness) * (1 - 0.6F * from_wood);
            result = colour_mix(result, linear_rgb({0.63F, 0.68F, 0.43F}), green);
        }
        return result;
    }

    Vector3f bark(const Vector3f& p, float radius) const {
        const float r = std::max(radius, 1e-3F);
        const float x = 2 * p.x() / r, y = 2 * p.y() / r;  // patches as wide as half a radius, and longer
        const float patches = noise(ColourNoise::BarkPatch, x + 0.7F * p.z(), y - 0.5F * p.z());
        const float grey =
            smooth_step(-0.2F, 0.6F, noise(ColourNoise::Patch, x - 0.4F * p.z(), y + 0.3F * p.z()));
        const Vector3f result = m_bark * (1 + 0.22F * patches);
        return colour_mix(result, Vector3f::Constant(luminance_of(result)), 0.45F * grey);
    }

    /// What weather and water do to all of it.
    Vector3f finished(const Vector3f& colour) const {
        const Vector3f grey = Vector3f(0.42F, 0.40F, 0.37F) * std::min(1.0F, 0.4F + luminance_of(colour));
        Vector3f result = colour_mix(colour, grey, 0.9F * m_weathering);
        if (m_wetness > 0) {
            // A wet surface sends part of the light back inside, so that dark and saturated colours grow more
            // so (Lekner and Dorf 1988).
            const float power = 1 + 0.22F * m_wetness;
            for (int k = 0; k < 3; ++k) result[k] = std::pow(std::max(0.0F, result[k]), power);
        }
        return result;
    }

    WoodPalette m_palette;
    std::array<std::uint32_t, 9> m_keys{};
    Vector3f m_pith, m_heartwood, m_sapwood, m_inner_bark, m_bark;  // linear
    float m_wetness = 0, m_weathering = 0;
};

}  // namespace

std::vector<Vector3f> vertex_colours(const BranchMesh& mesh, const FractureParameters& parameters) {
    const WoodPainter painter(parameters);
    std::vector<Vector3f> colours(mesh.vertex_count());
    parallel_blocks(colours.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v)
            colours[v] = painter.colour(mesh.positions[v], mesh.tissue[v], mesh.thorn[v], mesh.bundle[v]);
    });
    return colours;
}

}  // namespace windfall::fracture
