#include "picture/show_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace windfall::picture {
namespace {

constexpr int kLargestSize = 4096;
constexpr double kFruitElevation_deg = 22;
constexpr double kWoodElevation_deg = 30;
constexpr double kFromAbove_deg = 68;

template <class Number>
void require(const char* what, Number value, Number low, Number high) {
    if (!(value >= low && value <= high))
        throw InputError(fmt::format("{} must be {} to {}, not {}", what, low, high, value));
}

void check_options(const ShowOptions& options, int frame_count) {
    if (frame_count < 1) throw InputError("the take has no frames yet: there is nothing to show");
    require("the size of a picture", options.size, 16, kLargestSize);
    require("the number of samples", options.samples, 1, 65536);
    if (options.elevation_deg) require("the elevation of the camera", *options.elevation_deg, -5.0, 89.0);
    require("the azimuth of the camera", options.azimuth_deg, -3600.0, 3600.0);
    require("the number of frames on a sheet", options.sheet_frames, 1, 100);
    require("the number of views of a turntable", options.turntable_views, 1, 9999);
    require("the frames per second", options.frames_per_second, 0.1, 240.0);
    if (options.frame < -1 || options.frame >= frame_count)
        throw InputError(fmt::format("there is no frame {}: the take has the frames 0 to {} (-1: the last)",
                                     options.frame, frame_count - 1));
}

/// A broken branch from several sides, which says more than its only frame once.
std::vector<Shot> shots_from_all_sides(const ShowOptions& options, double elevation_deg) {
    const double front = options.azimuth_deg;
    const View near = options.view.value_or(View::Break);
    std::vector<Shot> shots{
        {0, front, elevation_deg, near, Framing::AllSides, {}, "front"},
        {0, front + 120, elevation_deg, near, Framing::AllSides, {}, "turned by 120\u00b0"},
        {0, front + 240, elevation_deg, near, Framing::AllSides, {}, "turned by 240\u00b0"},
        {0, front, kFromAbove_deg, near, Framing::AllSides, {}, "from above"},
    };
    if (!options.view) {
        shots.push_back({0, front, elevation_deg / 2, View::Whole, Framing::AllSides, {}, "the whole"});
        shots.push_back(
            {0, front + 180, elevation_deg / 2, View::Whole, Framing::AllSides, {}, "from behind"});
    }
    return shots;
}

}  // namespace

std::vector<int> evenly_chosen(int count, int most) {
    if (most == 1 || count == 1) return {count - 1};
    std::vector<int> chosen;
    const int n = std::min(count, most);
    for (int i = 0; i < n; ++i)
        chosen.push_back(static_cast<int>(std::lround(static_cast<double>(i) * (count - 1) / (n - 1))));
    return chosen;
}

ShowPlan plan_show(const ShowOptions& options, const std::filesystem::path& folder, int frame_count,
                   bool wood) {
    check_options(options, frame_count);
    const std::string suffix = options.colouring == Colouring::Material
                                   ? ""
                                   : "-" + colouring_names()[static_cast<std::size_t>(options.colouring)];
    const int single = options.frame < 0 ? frame_count - 1 : options.frame;
    const double elevation = options.elevation_deg.value_or(wood ? kWoodElevation_deg : kFruitElevation_deg);
    const View view = options.view.value_or(frame_count == 1 ? View::Break : View::Whole);
    ShowPlan plan;
    plan.folder = folder;
    const auto add = [&](int frame, double azimuth_deg, const std::filesystem::path& file) {
        plan.shots.push_back({frame, azimuth_deg, elevation, view,
                              options.kind == ShowKind::Turntable ? Framing::AllSides : Framing::OneSide,
                              file, ""});
    };
    const auto movie_folder = [&](const std::string& name) {
        plan.folder = folder / (name + suffix);
        plan.movie = folder / (name + suffix + ".mp4");
    };
    switch (options.kind) {
        case ShowKind::ContactSheet:
            plan.sheet = folder / ("contact-sheet" + suffix + ".png");
            if (wood && frame_count == 1)
                plan.shots = shots_from_all_sides(options, elevation);
            else
                for (const int frame : evenly_chosen(frame_count, options.sheet_frames))
                    add(frame, options.azimuth_deg, {});
            break;
        case ShowKind::SingleFrame:
            add(single, options.azimuth_deg, folder / fmt::format("frame-{:04}{}.png", single, suffix));
            break;
        case ShowKind::Turntable:
            movie_folder("turntable");
            for (int i = 0; i < options.turntable_views; ++i)
                add(single, options.azimuth_deg + 360.0 * i / options.turntable_views,
                    plan.folder / fmt::format("{:04}.png", i));
            break;
        case ShowKind::TimeLapse:
            movie_folder("time-lapse");
            for (int i = 0; i < frame_count; ++i)
                add(i, options.azimuth_deg, plan.folder / fmt::format("{:04}.png", i));
            break;
    }
    return plan;
}

void refuse_existing(const ShowPlan& plan) {
    std::vector<std::filesystem::path> files{plan.sheet, plan.movie};
    for (const Shot& shot : plan.shots) files.push_back(shot.file);
    for (const auto& file : files)
        if (!file.empty() && std::filesystem::exists(file))
            throw InputError(fmt::format(
                "{} exists already; use --force to replace it, or another output folder", file.string()));
}

}  // namespace windfall::picture
