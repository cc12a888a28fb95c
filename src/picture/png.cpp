// PNG by libspng.
#include <fmt/format.h>
#include <spng.h>

#include <cstdlib>
#include <memory>

#include "core/error.h"
#include "picture/image.h"

namespace windfall::picture {
namespace {

struct ContextFree {
    void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using Context = std::unique_ptr<spng_ctx, ContextFree>;

// Larger pictures than this are not ours; the limit keeps a damaged header from asking for all memory.
constexpr std::uint32_t kMaxSide = 1U << 16U;

}  // namespace

std::vector<std::byte> encode_png(const Image8& image) {
    const Context context(spng_ctx_new(SPNG_CTX_ENCODER));
    const auto check = [](int error) {
        if (error != 0) throw RunError(fmt::format("cannot make a PNG: {}", spng_strerror(error)));
    };
    if (!context) throw RunError("cannot make a PNG: no memory");
    check(spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1));
    spng_ihdr header{};
    header.width = static_cast<std::uint32_t>(image.width);
    header.height = static_cast<std::uint32_t>(image.height);
    header.color_type = SPNG_COLOR_TYPE_TRUECOLOR;
    header.bit_depth = 8;
    check(spng_set_ihdr(context.get(), &header));
    constexpr std::uint8_t kPerceptual = 0;
    check(spng_set_srgb(context.get(), kPerceptual));
    check(spng_encode_image(context.get(), image.bytes.data(), image.bytes.size(), SPNG_FMT_PNG,
                            SPNG_ENCODE_FINALIZE));
    std::size_t size = 0;
    int error = 0;
    const std::unique_ptr<void, decltype(&std::free)> buffer(
        spng_get_png_buffer(context.get(), &size, &error), &std::free);
    check(error);
    const auto* begin = static_cast<const std::byte*>(buffer.get());
    return {begin, begin + size};
}

Image8 decode_png(std::span<const std::byte> bytes) {
    const Context context(spng_ctx_new(0));
    const auto check = [](int error) {
        if (error != 0) throw InputError(fmt::format("cannot read the PNG: {}", spng_strerror(error)));
    };
    if (!context) throw RunError("cannot read the PNG: no memory");
    check(spng_set_image_limits(context.get(), kMaxSide, kMaxSide));
    check(spng_set_png_buffer(context.get(), bytes.data(), bytes.size()));
    spng_ihdr header{};
    check(spng_get_ihdr(context.get(), &header));
    std::size_t size = 0;
    check(spng_decoded_image_size(context.get(), SPNG_FMT_RGB8, &size));
    Image8 image(static_cast<int>(header.width), static_cast<int>(header.height));
    if (size != image.bytes.size()) throw InputError("cannot read the PNG: unexpected size of the picture");
    check(spng_decode_image(context.get(), image.bytes.data(), size, SPNG_FMT_RGB8, 0));
    return image;
}

}  // namespace windfall::picture
