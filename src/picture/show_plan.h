#pragma once
// Which pictures are to be made, before the first of them is.
#include <filesystem>
#include <string>
#include <vector>

#include "picture/show_take.h"

namespace windfall::picture {

/// One picture that is to be made.
struct Shot {
    int frame = 0;
    double azimuth_deg = 25;
    double elevation_deg = 22;
    View view = View::Whole;
    Framing framing = Framing::OneSide;
    std::filesystem::path file;  ///< empty: a cell of the sheet
    std::string caption;         ///< empty: that of the frame
};

struct ShowPlan {
    std::vector<Shot> shots;
    std::filesystem::path sheet;   ///< empty for none
    std::filesystem::path movie;   ///< empty for none
    std::filesystem::path folder;  ///< of the shots
};

/// Throws InputError for options that cannot be.
ShowPlan plan_show(const ShowOptions& options, const std::filesystem::path& folder, int frame_count,
                   bool wood);

/// Throws InputError when one of the files is there already.
void refuse_existing(const ShowPlan& plan);

/// Up to `most` of the frames 0 .. count - 1, evenly chosen, with the last and, if there are two, the first.
std::vector<int> evenly_chosen(int count, int most);

}  // namespace windfall::picture
