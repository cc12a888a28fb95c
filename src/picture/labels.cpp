#include "picture/labels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <vector>

#include "take/whole_file.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>

#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

namespace windfall::picture {
namespace {

constexpr std::uint64_t kMostFontBytes = 1U << 26U;

class Font {
  public:
    Font() {
        for (const char* path :
             {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/dejavu/DejaVuSans.ttf",
              "/usr/share/fonts/TTF/DejaVuSans.ttf"}) {
            try {
                m_bytes = take::read_whole_file(path, kMostFontBytes);
            } catch (const std::exception&) {
                continue;  // a picture without this font is still a picture
            }
            const auto* data = reinterpret_cast<const unsigned char*>(m_bytes.data());
            m_loaded = stbtt_InitFont(&m_info, data, stbtt_GetFontOffsetForIndex(data, 0)) != 0;
            if (m_loaded) return;
        }
    }
    bool loaded() const { return m_loaded; }
    const stbtt_fontinfo* info() const { return &m_info; }

  private:
    std::vector<std::byte> m_bytes;
    stbtt_fontinfo m_info{};
    bool m_loaded = false;
};

const Font& font() {
    static const Font instance;
    return instance;
}

/// Code points of UTF-8; a byte that is none becomes U+FFFD.
std::vector<int> code_points(const std::string& text) {
    std::vector<int> points;
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i]);
        const std::size_t length = lead < 0x80        ? 1
                                   : lead >> 5U == 6  ? 2
                                   : lead >> 4U == 14 ? 3
                                   : lead >> 3U == 30 ? 4
                                                      : 0;
        int point = length == 1 ? lead : lead & (0x7FU >> length);
        bool whole = length > 0 && i + length <= text.size();
        for (std::size_t k = 1; whole && k < length; ++k) {
            const auto next = static_cast<unsigned char>(text[i + k]);
            whole = next >> 6U == 2;
            point = point << 6 | (next & 0x3F);
        }
        points.push_back(whole ? point : 0xFFFD);
        i += whole ? length : 1;
    }
    return points;
}

void blend(Image8& image, int x, int y, std::array<std::uint8_t, 3> colour, float cover) {
    if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
    for (std::size_t c = 0; c < 3; ++c) {
        auto& byte = image.bytes[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                      static_cast<std::size_t>(x)) +
                                 c];
        byte = static_cast<std::uint8_t>(std::lround((1 - cover) * byte + cover * colour[c]));
    }
}

/// Calls place(glyph, pen) for every glyph of the line and returns its width.
template <class Place>
float set_line(const std::string& text, float scale, const Place& place) {
    float pen = 0;
    int before = 0;
    for (const int point : code_points(text)) {
        const int glyph = stbtt_FindGlyphIndex(font().info(), point);
        if (before != 0)
            pen += scale * static_cast<float>(stbtt_GetGlyphKernAdvance(font().info(), before, glyph));
        place(glyph, pen);
        int advance = 0, bearing = 0;
        stbtt_GetGlyphHMetrics(font().info(), glyph, &advance, &bearing);
        pen += scale * static_cast<float>(advance);
        before = glyph;
    }
    return pen;
}

float scale_of(int height) { return stbtt_ScaleForPixelHeight(font().info(), static_cast<float>(height)); }

// ---- the built-in font: letters of 7 x 12 units, ASCII only ----

constexpr int kPlainHeight = 12;

std::string ascii(const std::string& text) {
    std::string result;
    for (const int point : code_points(text))
        result += point >= 32 && point < 127 ? static_cast<char>(point) : '?';
    return result;
}

int plain_scale(int height) { return std::max(1, height / kPlainHeight); }

void draw_plain(Image8& image, const std::string& text, int x, int y, int height,
                std::array<std::uint8_t, 3> colour) {
    struct Corner {
        float x, y, z;
        unsigned char colour[4];
    };
    std::string line = ascii(text);
    std::vector<Corner> corners(4 * 70 * (line.size() + 1));
    const int quads = stb_easy_font_print(0, 0, line.data(), nullptr, corners.data(),
                                          static_cast<int>(corners.size() * sizeof(Corner)));
    const int scale = plain_scale(height);
    for (std::size_t q = 0; q < static_cast<std::size_t>(quads); ++q) {
        const Corner &low = corners[4 * q], &high = corners[4 * q + 2];
        for (int v = scale * static_cast<int>(low.y); v < scale * static_cast<int>(high.y); ++v)
            for (int u = scale * static_cast<int>(low.x); u < scale * static_cast<int>(high.x); ++u)
                blend(image, x + u, y + v, colour, 1);
    }
}

}  // namespace

int text_width(const std::string& text, int height) {
    if (font().loaded())
        return static_cast<int>(std::ceil(set_line(text, scale_of(height), [](int, float) {})));
    std::string line = ascii(text);
    return plain_scale(height) * stb_easy_font_width(line.data());
}

void draw_text(Image8& image, const std::string& text, int x, int y, int height,
               std::array<std::uint8_t, 3> colour) {
    if (!font().loaded()) return draw_plain(image, text, x, y, height, colour);
    const float scale = scale_of(height);
    int ascent = 0, descent = 0, gap = 0;
    stbtt_GetFontVMetrics(font().info(), &ascent, &descent, &gap);
    const int baseline = y + static_cast<int>(std::lround(scale * static_cast<float>(ascent)));
    set_line(text, scale, [&](int glyph, float pen) {
        const float whole = std::floor(pen);
        int left = 0, top = 0, right = 0, bottom = 0;
        stbtt_GetGlyphBitmapBoxSubpixel(font().info(), glyph, scale, scale, pen - whole, 0, &left, &top,
                                        &right, &bottom);
        const int width = right - left, rows = bottom - top;
        if (width <= 0 || rows <= 0) return;
        std::vector<unsigned char> cover(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows));
        stbtt_MakeGlyphBitmapSubpixel(font().info(), cover.data(), width, rows, width, scale, scale,
                                      pen - whole, 0, glyph);
        for (int v = 0; v < rows; ++v)
            for (int u = 0; u < width; ++u)
                blend(image, x + static_cast<int>(whole) + left + u, baseline + top + v, colour,
                      static_cast<float>(cover[static_cast<std::size_t>(v * width + u)]) / 255);
    });
}

}  // namespace windfall::picture
