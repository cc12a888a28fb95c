#include <gtest/gtest.h>

#include "core/error.h"
#include "picture/contact_sheet.h"
#include "picture/image.h"
#include "picture/labels.h"

namespace windfall::picture {
namespace {

Image8 gradient(int width, int height) {
    Image8 image(width, height);
    for (std::size_t i = 0; i < image.bytes.size(); ++i)
        image.bytes[i] = static_cast<std::uint8_t>(i * 7 % 251);
    return image;
}

TEST(PictureImage, PngComesBackAsItWas) {
    const Image8 image = gradient(37, 19);
    const Image8 read = decode_png(encode_png(image));
    EXPECT_EQ(read.width, 37);
    EXPECT_EQ(read.height, 19);
    EXPECT_EQ(read.bytes, image.bytes);
}

TEST(PictureImage, DamagedPngIsAnInputError) {
    auto bytes = encode_png(gradient(16, 16));
    bytes.resize(bytes.size() / 2);
    EXPECT_THROW(decode_png(bytes), InputError);
    EXPECT_THROW(decode_png({}), InputError);
}

TEST(PictureImage, SrgbCurveGoesThereAndBack) {
    for (int i = 0; i <= 100; ++i) {
        const float x = static_cast<float>(i) / 100;
        EXPECT_NEAR(linear_from_srgb(srgb_from_linear(x)), x, 1e-5);
    }
    EXPECT_NEAR(srgb_from_linear(0.2140F), 0.5, 1e-3);
}

TEST(PictureImage, ToneCurvesRiseAndStayInRange) {
    for (const ToneCurve curve : {ToneCurve::Filmic, ToneCurve::Plain}) {
        int before = -1;
        for (int i = 0; i < 200; ++i) {
            const float light = 0.02F * static_cast<float>(i);
            const Image8 shown = to_srgb8(Image(1, 1, {light, light, light}), curve);
            EXPECT_GE(static_cast<int>(shown.bytes[0]), before - 1);  // the dither may take one step back
            before = std::max(before, static_cast<int>(shown.bytes[0]));
        }
        EXPECT_GT(before, 250);
    }
    const Image8 plain = to_srgb8(Image(1, 1, {1, 0, 0.2140F}), ToneCurve::Plain);
    EXPECT_EQ(plain.bytes[0], 255);
    EXPECT_EQ(plain.bytes[1], 0);
    EXPECT_NEAR(plain.bytes[2], 128, 1);
}

TEST(PictureImage, PasteCutsAtTheEdges) {
    const Image8 source(4, 4, {1, 2, 3});
    for (const auto [x, y, count] : {std::array{-2, -3, 2}, {8, 8, 4}, {-4, 0, 0}, {3, 3, 16}, {50, 50, 0}}) {
        Image8 target(10, 10, {9, 9, 9});
        paste(target, source, x, y);
        EXPECT_EQ(std::count(target.bytes.begin(), target.bytes.end(), 1), count) << x << " " << y;
    }
}

TEST(PictureImage, TextLeavesInkInsideItsBoxOnly) {
    Image8 image(300, 60);
    const int width = text_width("shrinkage 0.15", 24);
    ASSERT_GT(width, 40);
    ASSERT_LT(width, 250);
    draw_text(image, "shrinkage 0.15", 20, 15, 24, {0, 0, 0});
    int ink = 0;
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 300; ++x)
            if (image.bytes[3 * static_cast<std::size_t>(y * 300 + x)] < 128) {
                ++ink;
                EXPECT_GE(x, 18);
                EXPECT_LE(x, 22 + width);
                EXPECT_GE(y, 14);
                EXPECT_LE(y, 42);
            }
    EXPECT_GT(ink, 100);
    draw_text(image, "caf\u00e9 \xff beyond the edge of the picture", 280, 50, 24,
              {0, 0, 0});  // must not write outside
}

TEST(PictureImage, ContactSheetHasTheRightSizeAndItsPictures) {
    for (const int count : {1, 2, 3, 4, 5, 6, 7, 12}) {
        std::vector<SheetCell> cells(static_cast<std::size_t>(count),
                                     {Image8(60, 60, {10, 200, 30}), "shrinkage 0.1"});
        const Image8 page = contact_sheet("Jujube, prolate", cells);
        const SheetLayout layout = sheet_layout(count, 60);
        EXPECT_GE(layout.columns * layout.rows, count);
        EXPECT_EQ(page.width, layout.columns * 60 + (layout.columns + 1) * layout.gap);
        EXPECT_EQ(page.height, layout.height());
        std::ptrdiff_t of_pictures = 0;
        for (std::size_t i = 0; i + 2 < page.bytes.size(); i += 3)
            of_pictures += page.bytes[i] == 10 && page.bytes[i + 1] == 200 && page.bytes[i + 2] == 30;
        EXPECT_EQ(of_pictures, count * 60 * 60);
    }
}

}  // namespace
}  // namespace windfall::picture
