#include "picture/path_tracer.h"

#include <fmt/format.h>
#include <immintrin.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "core/random.h"
#include "picture/denoise.h"
#include "picture/integrator.h"

namespace windfall::picture {
namespace {

constexpr int kTile = 16;
// Samples between two reports of progress.
constexpr int kPass = 8;

/// Denormal numbers slow Embree down; they are flushed to zero in the thread at work, and only while it is at
/// work.
class FlushDenormals {
  public:
    FlushDenormals() : m_before(_mm_getcsr()) { _mm_setcsr(m_before | 0x8040U); }
    ~FlushDenormals() { _mm_setcsr(m_before); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

  private:
    unsigned m_before;
};

struct Eye {
    Vec3f eye, forward, right, up;
    float half_height;  // of the picture at distance 1

    explicit Eye(const Camera& camera) {
        const double rad = std::numbers::pi / 180;
        const double azimuth = camera.azimuth_deg * rad, elevation = camera.elevation_deg * rad;
        const Vec3f back(static_cast<float>(std::cos(elevation) * std::sin(azimuth)),
                         static_cast<float>(std::sin(elevation)),
                         static_cast<float>(std::cos(elevation) * std::cos(azimuth)));
        eye = camera.target + static_cast<float>(camera.distance) * back;
        forward = -back;
        right = Vec3f(static_cast<float>(std::cos(azimuth)), 0, static_cast<float>(-std::sin(azimuth)));
        up = right.cross(forward);
        half_height = static_cast<float>(std::tan(camera.vertical_field_of_view_deg * rad / 2));
    }
};

void check(const RenderSettings& s) {
    constexpr int kLargest = 16384;
    if (s.width < 1 || s.height < 1 || s.width > kLargest || s.height > kLargest)
        throw InputError(fmt::format("a picture of {} x {} pixels cannot be rendered; give 1 to {} a side",
                                     s.width, s.height, kLargest));
    if (s.samples < 1 || s.samples > 65536)
        throw InputError(fmt::format("{} samples per pixel cannot be; give 1 to 65536", s.samples));
    if (s.bounces < 1 || s.bounces > 64)
        throw InputError(fmt::format("{} reflections on a path cannot be; give 1 to 64", s.bounces));
}

std::uint32_t pixel_key(const RenderSettings& settings, int x, int y) {
    const auto index = static_cast<std::uint64_t>(y) << 32U | static_cast<std::uint64_t>(x);
    return static_cast<std::uint32_t>(random_uniform4(settings.seed, RandomPurpose::PictureSample, index)[0] *
                                      0x1p32);
}

class Renderer {
  public:
    Renderer(const Scene& scene, const RenderSettings& settings)
        : m_settings(settings),
          m_surfaces(scene),
          m_integrator(scene, m_surfaces, settings.bounces),
          m_view(scene.camera),
          m_sums(static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height)) {}

    Image run(const RunContext& context) {
        const auto start = std::chrono::steady_clock::now();
        const auto across = static_cast<std::size_t>((m_settings.width + kTile - 1) / kTile);
        const auto down = static_cast<std::size_t>((m_settings.height + kTile - 1) / kTile);
        for (int first = 0; first < m_settings.samples; first += kPass) {
            const int last = std::min(first + kPass, m_settings.samples);
            parallel_for_each(across * down, [&](std::size_t tile) {
                context.throw_if_cancelled();
                render_tile(static_cast<int>(tile % across) * kTile, static_cast<int>(tile / across) * kTile,
                            first, last);
            });
            const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
            const double done = static_cast<double>(last) / m_settings.samples;
            context.progress({"rendering", done, 1, elapsed.count() * (1 - done) / done, ""});
        }
        return m_settings.denoise
                   ? denoised_image(m_settings.width, m_settings.height, m_sums, m_settings.samples)
                   : mean_image(m_settings.width, m_settings.height, m_sums, m_settings.samples);
    }

  private:
    void render_tile(int left, int top, int first, int last) {
        const FlushDenormals flush;
        for (int y = top; y < std::min(top + kTile, m_settings.height); ++y)
            for (int x = left; x < std::min(left + kTile, m_settings.width); ++x) {
                PixelSums& sums =
                    m_sums[static_cast<std::size_t>(y) * static_cast<std::size_t>(m_settings.width) +
                           static_cast<std::size_t>(x)];
                const std::uint32_t key = pixel_key(m_settings, x, y);
                for (int s = first; s < last; ++s) add_sample(sums, x, y, key, static_cast<std::uint32_t>(s));
            }
    }

    void add_sample(PixelSums& sums, int x, int y, std::uint32_t key, std::uint32_t sample) const {
        Sampler sampler(key, sample);
        const auto jitter = sampler.next2();
        const auto width = static_cast<float>(m_settings.width),
                   height = static_cast<float>(m_settings.height);
        // a tent over two pixels: smoother edges than a box
        const auto tent = [](float u) { return u < 0.5F ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u); };
        const float px = static_cast<float>(x) + 0.5F + 0.75F * tent(jitter[0]);
        const float py = static_cast<float>(y) + 0.5F + 0.75F * tent(jitter[1]);
        const float scale = 2 * m_view.half_height / height;
        const Vec3f direction =
            m_view.forward + (px - width / 2) * scale * m_view.right + (height / 2 - py) * scale * m_view.up;
        const PathSample path =
            m_integrator.trace({m_view.eye, direction.normalized()}, 1 - py / height, sampler);
        if (!path.radiance.allFinite()) return;
        const float light =
            0.2126F * path.radiance.x() + 0.7152F * path.radiance.y() + 0.0722F * path.radiance.z();
        sums.radiance += path.radiance;
        sums.albedo += path.albedo;
        sums.normal += path.normal;
        sums.luminance += light;
        sums.luminance_sq += light * light;
    }

    RenderSettings m_settings;
    Surfaces m_surfaces;
    Integrator m_integrator;
    Eye m_view;
    std::vector<PixelSums> m_sums;
};

}  // namespace

Image render(const Scene& scene, const RenderSettings& settings, const RunContext& context) {
    check(settings);
    return Renderer(scene, settings).run(context);
}

}  // namespace windfall::picture
