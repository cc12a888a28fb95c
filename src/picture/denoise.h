#pragma once
// Takes the grain out of a rendered picture.
#include <vector>

#include "picture/image.h"
#include "picture/scene.h"

namespace windfall::picture {

/// Sums over the paths of one pixel.
struct PixelSums {
    Vec3f radiance = Vec3f::Zero();
    Vec3f albedo = Vec3f::Zero();
    Vec3f normal = Vec3f::Zero();
    float luminance = 0;
    float luminance_sq = 0;
};

/// Means over `samples` paths per pixel, as they are.
Image mean_image(int width, int height, const std::vector<PixelSums>& sums, int samples);

/// The same, smoothed within what has the same normal and colour and differs by no more than the grain.
Image denoised_image(int width, int height, const std::vector<PixelSums>& sums, int samples);

}  // namespace windfall::picture
