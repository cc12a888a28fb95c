#include "recipe/painted_mask.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "take/whole_file.h"

namespace windfall::recipe {

PaintedMask::PaintedMask(const std::string& key, const std::filesystem::path& file) {
    constexpr std::uint64_t kLargestMask = std::uint64_t{1} << 28U;
    try {
        m_image = picture::decode_png(take::read_whole_file(file, kLargestMask));
    } catch (const std::exception& error) {
        throw InputError(fmt::format("{} {}: {}", key, file.string(), error.what()));
    }
    if (m_image.width != m_image.height || m_image.width < 1)
        throw InputError(fmt::format("{} {} has {} x {} pixels; it must be square", key, file.string(),
                                     m_image.width, m_image.height));
}

float PaintedMask::at(const geometry::Vec2& uv) const {
    const auto pixel = [size = m_image.width](double x) {
        return static_cast<std::size_t>(std::clamp(static_cast<int>(x * size), 0, size - 1));
    };
    const std::size_t first =
        3 * (pixel(1 - uv.y()) * static_cast<std::size_t>(m_image.width) + pixel(uv.x()));
    // Rec. 709
    return (0.2126F * m_image.bytes[first] + 0.7152F * m_image.bytes[first + 1] +
            0.0722F * m_image.bytes[first + 2]) /
           255;
}

}  // namespace windfall::recipe
