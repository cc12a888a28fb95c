#pragma once
// Several pictures on one page.
#include <string>
#include <vector>

#include "picture/image.h"

namespace windfall::picture {

struct SheetCell {
    Image8 picture;
    std::string caption;
};

/// The size of a sheet and where its cells stand. All cells are squares of one size.
struct SheetLayout {
    int columns = 1, rows = 1;
    int cell = 0, gap = 0, caption_height = 0, title_height = 0;
    int width() const { return columns * cell + (columns + 1) * gap; }
    int height() const { return title_height + rows * (cell + caption_height) + (rows + 1) * gap; }
};

/// One row for up to three cells, else two or more.
SheetLayout sheet_layout(int cells, int cell_size);

/// The page: a title line, then the cells in reading order, each with its caption below.
Image8 contact_sheet(const std::string& title, const std::vector<SheetCell>& cells);

}  // namespace windfall::picture
