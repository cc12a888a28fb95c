#pragma once
// Pictures of a take: contact sheet, single frames, turntable and time lapse.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/parameter.h"
#include "core/run_context.h"
#include "picture/colouring.h"
#include "picture/wood_surface.h"
#include "take/take_reader.h"

namespace windfall::picture {

enum class ShowKind { ContactSheet, SingleFrame, Turntable, TimeLapse };

/// "contact-sheet", "frame", "turntable", "time-lapse"; InputError for any other name.
ShowKind show_kind_named(const std::string& name);
const std::vector<std::string>& show_kind_names();

/// "whole", "break"; InputError for any other name.
View view_named(const std::string& name);
const std::vector<std::string>& view_names();

struct ShowOptions {
    std::filesystem::path output_folder;  ///< made when missing; empty: "pictures" in the folder of the take
    ShowKind kind = ShowKind::ContactSheet;
    Colouring colouring = Colouring::Material;
    int size = 480;           ///< pixels along a side of one picture (a cell of the sheet), 16 .. 4096
    int samples = 48;         ///< paths per pixel, 1 .. 65536
    double azimuth_deg = 25;  ///< camera about the vertical axis
    /// camera above the horizon, -5 .. 89; empty: 22 for fruit, 30 for wood
    std::optional<double> elevation_deg = {};
    /// wood: the broken end or all of it; empty: the broken end of a still take, all of one that moves, and
    /// on the contact sheet of a still take both
    std::optional<View> view = {};
    int sheet_frames = 6;      ///< most frames on a contact sheet; the first and the last are always there
                               ///< (wood in a single frame is shown from several sides instead)
    int frame = -1;            ///< single frame and turntable: which frame; -1 is the last
    int turntable_views = 72;  ///< pictures of a whole turn
    double frames_per_second = 24;
    bool denoise = true;
    std::vector<std::pair<std::string, ParameterValue>> look;  ///< fruit: "look.*" in place of the take's own
    /// Adds to a frame what its take does not keep and a picture needs (decay: shading maps, mold); may be
    /// empty.
    std::function<void(take::Frame&)> dress = {};
    bool overwrite = false;         ///< pictures that exist may be replaced
    std::string ffmpeg = "ffmpeg";  ///< program that makes the movies
};

struct ShowOutput {
    std::vector<std::filesystem::path> pictures;  ///< PNG files written
    std::filesystem::path movie;                  ///< empty when none was made
    std::string note;                             ///< for people: why there is no movie; else empty
};

/// Makes the pictures. Writes contact-sheet.png, frame-0012.png, turntable/0000.png ... and turntable.mp4, or
/// time-lapse/0000.png ... and time-lapse.mp4 into the output folder; any other colouring than the material
/// is part of the name ("contact-sheet-curvature.png"). The movies need ffmpeg: without it the pictures are
/// written all the same and `note` says what to install. Throws InputError for options that cannot be, a take
/// without frames, or pictures that exist already (without `overwrite`); RunError when a file cannot be
/// written or ffmpeg fails; Cancelled.
ShowOutput show_take(const take::TakeReader& take, const ShowOptions& options, const RunContext& context);

}  // namespace windfall::picture
