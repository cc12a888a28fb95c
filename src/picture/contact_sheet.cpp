#include "picture/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "picture/labels.h"

namespace windfall::picture {
namespace {

constexpr std::array<std::uint8_t, 3> kPaper{250, 249, 247};
constexpr std::array<std::uint8_t, 3> kInk{45, 42, 40};

/// The line in the largest letters up to `height` that fit; at least 6 pixels, below which nothing can be
/// read.
void draw_centred(Image8& page, const std::string& text, int left, int width, int top, int height) {
    int size = height;
    while (size > 6 && text_width(text, size) > width) --size;
    draw_text(page, text, left + std::max(0, (width - text_width(text, size)) / 2), top + (height - size) / 2,
              size, kInk);
}

}  // namespace

SheetLayout sheet_layout(int cells, int cell_size) {
    SheetLayout layout;
    layout.columns = cells <= 3   ? cells
                     : cells == 4 ? 2
                                  : static_cast<int>(std::ceil(std::sqrt(1.5 * cells)));
    layout.rows = (cells + layout.columns - 1) / layout.columns;
    layout.cell = cell_size;
    layout.gap = std::max(4, cell_size / 30);
    layout.caption_height = std::max(10, cell_size / 16);
    layout.title_height = std::max(12, cell_size / 10);
    return layout;
}

Image8 contact_sheet(const std::string& title, const std::vector<SheetCell>& cells) {
    const SheetLayout layout = sheet_layout(static_cast<int>(cells.size()), cells.front().picture.width);
    Image8 page(layout.width(), layout.height(), kPaper);
    draw_centred(page, title, layout.gap, page.width - 2 * layout.gap, layout.gap * 3 / 4,
                 layout.title_height * 2 / 3);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const int column = static_cast<int>(i) % layout.columns, row = static_cast<int>(i) / layout.columns;
        const int x = layout.gap + column * (layout.cell + layout.gap);
        const int y =
            layout.title_height + layout.gap + row * (layout.cell + layout.caption_height + layout.gap);
        paste(page, cells[i].picture, x, y);
        draw_centred(page, cells[i].caption, x, layout.cell, y + layout.cell + layout.caption_height / 6,
                     layout.caption_height * 3 / 4);
    }
    return page;
}

}  // namespace windfall::picture
