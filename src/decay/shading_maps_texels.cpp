#include "decay/shading_maps_texels.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace windfall::decay {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr int kMostTexelsASide = 1 << 14;

/// A triangle of the skin in the picture: corners in texels (centres of texels are whole numbers), places in
/// metres.
struct TexturedTriangle {
    std::array<Vector2f, 3> texels;
    std::array<Vector3f, 3> places_m;
};

void fill_triangle(ShadingTexels& texels, const TexturedTriangle& triangle) {
    const Vector2f a = triangle.texels[0], ab = triangle.texels[1] - a, ac = triangle.texels[2] - a;
    const float area = ab.x() * ac.y() - ab.y() * ac.x();
    if (!(std::abs(area) > 1e-12F)) return;
    const Vector3f p = triangle.places_m[0], pb = triangle.places_m[1] - p, pc = triangle.places_m[2] - p;
    // How the place moves with the texel, across and down.
    const Vector3f by_x = (pb * ac.y() - pc * ab.y()) / area, by_y = (pc * ab.x() - pb * ac.x()) / area;
    const auto a_metre = [](const Vector3f& step) { return 1 / std::max(step.norm(), 1e-12F); };

    Vector2f low = a, high = a;
    for (const Vector2f& corner : triangle.texels) {
        low = low.cwiseMin(corner);
        high = high.cwiseMax(corner);
    }
    const int left = std::max(0, static_cast<int>(std::ceil(low.x())));
    const int top = std::max(0, static_cast<int>(std::ceil(low.y())));
    const int right = std::min(texels.width - 1, static_cast<int>(std::floor(high.x())));
    const int bottom = std::min(texels.height - 1, static_cast<int>(std::floor(high.y())));
    constexpr float kEdge = -1e-4F;  // texels on an edge belong to both sides
    for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x) {
            const Vector2f d = Vector2f(static_cast<float>(x), static_cast<float>(y)) - a;
            const float s = (d.x() * ac.y() - d.y() * ac.x()) / area;
            const float t = (ab.x() * d.y() - ab.y() * d.x()) / area;
            if (s < kEdge || t < kEdge || s + t > 1 - kEdge) continue;
            const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(texels.width) +
                           static_cast<std::size_t>(x);
            texels.places_m[i] = p + s * pb + t * pc;
            texels.covered[i] = 1;
            texels.across_per_m[i] = a_metre(by_x);
            texels.up_per_m[i] = a_metre(by_y);
        }
}

/// One more ring of texels about the charts.
void widen_charts(ShadingTexels& texels) {
    const std::vector<std::uint8_t> before = texels.covered;
    const int width = texels.width, height = texels.height;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto i =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
            if (before[i] != 0) continue;
            constexpr int kRing[8][2] = {{-1, 0},  {1, 0},  {0, -1}, {0, 1},
                                         {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
            for (const auto& step : kRing) {
                const int nx = x + step[0], ny = y + step[1];
                if (nx < 0 || ny < 0 || nx >= width || ny >= height) continue;
                const auto n = static_cast<std::size_t>(ny) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(nx);
                if (before[n] == 0) continue;
                texels.places_m[i] = texels.places_m[n];
                texels.across_per_m[i] = texels.across_per_m[n];
                texels.up_per_m[i] = texels.up_per_m[n];
                texels.covered[i] = 1;
                break;
            }
        }
}

}  // namespace

ShadingTexels::ShadingTexels(const take::TakeMesh& mesh, double unit_length_m, int map_width, int map_height)
    : width(map_width), height(map_height) {
    const auto& rest = mesh.rest;
    if (rest.corner_uvs.size() != rest.faces.size() || rest.faces.empty())
        throw InputError(
            fmt::format("mesh '{}' has no texture coordinates, so it can have no maps", mesh.name));
    if (width < 1 || height < 1 || width > kMostTexelsASide || height > kMostTexelsASide)
        throw InputError(fmt::format("a map of {} x {} texels cannot be; give 1 to {} a side", width, height,
                                     kMostTexelsASide));
    const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    places_m.assign(count, Vector3f::Zero());
    covered.assign(count, 0);
    across_per_m.assign(count, 0);
    up_per_m.assign(count, 0);

    Vector3f low = Vector3f::Constant(1e30F), high = -low;
    std::vector<Vector3f> vertices_m;
    for (const auto& position : rest.positions) {
        vertices_m.emplace_back((unit_length_m * position).cast<float>());
        low = low.cwiseMin(vertices_m.back());
        high = high.cwiseMax(vertices_m.back());
    }
    centre_m = (low + high) / 2;
    radius_m = std::max((high - low).maxCoeff() / 2, 1e-9F);

    for (std::size_t f = 0; f < rest.faces.size(); ++f) {
        const auto corner = [&](std::size_t k) {
            const auto& uv = rest.corner_uvs[f][k];
            return Vector2f(static_cast<float>(uv.x()) * static_cast<float>(width) - 0.5F,
                            static_cast<float>(1 - uv.y()) * static_cast<float>(height) - 0.5F);
        };
        const auto place = [&](std::size_t k) {
            return vertices_m[static_cast<std::size_t>(rest.faces[f][k])];
        };
        const auto triangle = [&](std::size_t i, std::size_t j, std::size_t k) {
            fill_triangle(*this, {{corner(i), corner(j), corner(k)}, {place(i), place(j), place(k)}});
        };
        triangle(0, 1, 2);
        if (geometry::corner_count(rest.faces[f]) == 4) triangle(0, 2, 3);
    }
    for (int ring = 0; ring < kMargin; ++ring) widen_charts(*this);
}

}  // namespace windfall::decay
