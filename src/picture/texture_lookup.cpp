#include "picture/texture_lookup.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "picture/image.h"
#include "take/map_lookup.h"

namespace windfall::picture {
namespace {

/// From the sRGB curve to light, by a table that is interpolated: every ray asks three times.
class LightTable {
  public:
    LightTable() {
        for (std::size_t i = 0; i < m_values.size(); ++i)
            m_values[i] = linear_from_srgb(static_cast<float>(i) / kSteps);
    }
    float operator()(float srgb) const {
        const float place = std::clamp(srgb, 0.0F, 1.0F) * kSteps;
        const auto i = std::min(static_cast<std::size_t>(place), m_values.size() - 2);
        const float part = place - static_cast<float>(i);
        return m_values[i] + part * (m_values[i + 1] - m_values[i]);
    }

  private:
    static constexpr int kSteps = 1024;
    std::array<float, kSteps + 1> m_values{};
};

float value_or(const take::FrameMap& map, const Eigen::Vector2f& uv, float without) {
    return map.values.empty() ? without : take::map_value(map, uv.x(), uv.y());
}

/// How the place on the surface moves with u and with v, as unit vectors in the tangent plane; false where
/// the triangle has no area in the picture.
bool tangents(const SurfacePoint& point, Vec3f& along_u, Vec3f& along_v) {
    const auto& positions = point.mesh->positions;
    const Vec3f a = positions[point.corners[1]] - positions[point.corners[0]];
    const Vec3f b = positions[point.corners[2]] - positions[point.corners[0]];
    const Eigen::Vector2f s = point.corner_uvs[1] - point.corner_uvs[0],
                          t = point.corner_uvs[2] - point.corner_uvs[0];
    const float area = s.x() * t.y() - s.y() * t.x();
    if (!(std::abs(area) > 1e-14F)) return false;
    const auto on_plane = [&](const Vec3f& v) { return Vec3f(v - v.dot(point.normal) * point.normal); };
    along_u = on_plane((a * t.y() - b * s.y()) / area);
    along_v = on_plane((b * s.x() - a * t.x()) / area);
    if (!(along_u.norm() > 1e-12F && along_v.norm() > 1e-12F)) return false;
    along_u.normalize();
    along_v.normalize();
    return true;
}

void tilt(SurfacePoint& point, const take::FrameMap& map) {
    if (map.values.empty() || map.components < 3) return;
    Vec3f along_u, along_v;
    if (!tangents(point, along_u, along_v)) return;
    const auto texel = take::map_values(map, point.uv.x(), point.uv.y());
    const Vec3f tilted =
        ((2 * texel[0] - 1) * along_u + (2 * texel[1] - 1) * along_v + (2 * texel[2] - 1) * point.normal)
            .normalized();
    // tilted out of sight of its own face it would be black
    if (tilted.dot(point.face_normal) > 0.05F) point.normal = tilted;
}

}  // namespace

Vec3f texture_colour(const take::FrameMap& map, const Eigen::Vector2f& uv) {
    static const LightTable table;
    const auto texel = take::map_values(map, uv.x(), uv.y());
    if (!map.srgb) return {texel[0], texel[1], texel[2]};
    return {table(texel[0]), table(texel[1]), table(texel[2])};
}

void apply_texture(SurfacePoint& point) {
    if (point.mesh == nullptr || point.mesh->texture == nullptr) return;
    const SurfaceTexture& texture = *point.mesh->texture;
    const float bare = 1 - value_or(texture.mold_mask, point.uv, 0);
    point.roughness = value_or(texture.roughness, point.uv, point.roughness);
    point.gloss *= bare;  // spores are dull
    point.pores *= bare;
    if (!texture.subsurface_color.values.empty()) {
        const Vec3f colour = texture_colour(texture.subsurface_color, point.uv);
        point.scatter = point.scatter.maxCoeff() * colour / std::max(colour.maxCoeff(), 1e-3F);
    }
    point.scatter *= bare;
    tilt(point, texture.normal);
}

}  // namespace windfall::picture
