#pragma once
// Text in pictures: DejaVu Sans where it is installed, else a plain built-in font.
#include <array>
#include <cstdint>
#include <string>

#include "picture/image.h"

namespace windfall::picture {

/// Width in pixels of a line of text (UTF-8) whose letters are `height` pixels high.
int text_width(const std::string& text, int height);

/// Draws one line with its top left corner at (x, y); what would lie outside of the picture is left out.
void draw_text(Image8& image, const std::string& text, int x, int y, int height,
               std::array<std::uint8_t, 3> colour);

}  // namespace windfall::picture
