#include "picture/show_take.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/error.h"
#include "picture/contact_sheet.h"
#include "picture/movie.h"
#include "picture/names.h"
#include "picture/path_tracer.h"
#include "picture/stage.h"
#include "take/whole_file.h"

namespace windfall::picture {
namespace {

constexpr int kLargestSize = 4096;
constexpr std::int64_t kMostSheetPixels = 400'000'000;
/// Magnitudes up to this share of the vertices span the false colours; the rest is cut, so that a few sharp
/// creases do not make all else pale.
constexpr double kFalseColourFraction = 0.9;
constexpr int kScaleFrames = 6;

template <class Number>
void require(const char* what, Number value, Number low, Number high) {
    if (!(value >= low && value <= high))
        throw InputError(fmt::format("{} must be {} to {}, not {}", what, low, high, value));
}

void check(const ShowOptions& options, int frame_count) {
    if (frame_count < 1) throw InputError("the take has no frames yet: there is nothing to show");
    require("the size of a picture", options.size, 16, kLargestSize);
    require("the number of samples", options.samples, 1, 65536);
    require("the elevation of the camera", options.elevation_deg, -5.0, 89.0);
    require("the azimuth of the camera", options.azimuth_deg, -3600.0, 3600.0);
    require("the number of frames on a sheet", options.sheet_frames, 1, 100);
    require("the number of views of a turntable", options.turntable_views, 1, 9999);
    require("the frames per second", options.frames_per_second, 0.1, 240.0);
    if (options.frame < -1 || options.frame >= frame_count)
        throw InputError(fmt::format("there is no frame {}: the take has the frames 0 to {} (-1: the last)",
                                     options.frame, frame_count - 1));
}

/// Up to `most` of the frames 0 .. count - 1, evenly chosen, with the last and, if there are two, the first.
std::vector<int> evenly_chosen(int count, int most) {
    if (most == 1 || count == 1) return {count - 1};
    std::vector<int> chosen;
    const int n = std::min(count, most);
    for (int i = 0; i < n; ++i)
        chosen.push_back(static_cast<int>(std::lround(static_cast<double>(i) * (count - 1) / (n - 1))));
    return chosen;
}

/// One picture that is to be made.
struct Shot {
    int frame;
    double azimuth_deg;
    std::filesystem::path file;  ///< empty: a cell of the sheet
    std::string caption;
};

struct Plan {
    std::vector<Shot> shots;
    std::filesystem::path sheet;   ///< empty for none
    std::filesystem::path movie;   ///< empty for none
    std::filesystem::path folder;  ///< of the shots
};

Plan plan_of(const ShowOptions& options, const std::filesystem::path& folder, int frame_count) {
    const std::string suffix = options.colouring == Colouring::Material
                                   ? ""
                                   : "-" + colouring_names()[static_cast<std::size_t>(options.colouring)];
    const int single = options.frame < 0 ? frame_count - 1 : options.frame;
    Plan plan;
    plan.folder = folder;
    const auto movie_folder = [&](const std::string& name) {
        plan.folder = folder / (name + suffix);
        plan.movie = folder / (name + suffix + ".mp4");
    };
    switch (options.kind) {
        case ShowKind::ContactSheet:
            plan.sheet = folder / ("contact-sheet" + suffix + ".png");
            for (const int frame : evenly_chosen(frame_count, options.sheet_frames))
                plan.shots.push_back({frame, options.azimuth_deg, {}, ""});
            break;
        case ShowKind::SingleFrame:
            plan.shots.push_back(
                {single, options.azimuth_deg, folder / fmt::format("frame-{:04}{}.png", single, suffix), ""});
            break;
        case ShowKind::Turntable:
            movie_folder("turntable");
            for (int i = 0; i < options.turntable_views; ++i)
                plan.shots.push_back({single, options.azimuth_deg + 360.0 * i / options.turntable_views,
                                      plan.folder / fmt::format("{:04}.png", i), ""});
            break;
        case ShowKind::TimeLapse:
            movie_folder("time-lapse");
            for (int i = 0; i < frame_count; ++i)
                plan.shots.push_back({i, options.azimuth_deg, plan.folder / fmt::format("{:04}.png", i), ""});
            break;
    }
    return plan;
}

void refuse_existing(const Plan& plan) {
    std::vector<std::filesystem::path> files{plan.sheet, plan.movie};
    for (const Shot& shot : plan.shots) files.push_back(shot.file);
    for (const auto& file : files)
        if (!file.empty() && std::filesystem::exists(file))
            throw InputError(fmt::format(
                "{} exists already; use --force to replace it, or another output folder", file.string()));
}

StageSettings stage_settings(const take::TakeReader& take, const ShowOptions& options) {
    StageSettings settings;
    settings.look = look_from_json(take.info().look);
    for (const auto& [key, value] : options.look) set_look(settings.look, key, value);
    settings.colouring = options.colouring;
    settings.azimuth_deg = options.azimuth_deg;
    settings.elevation_deg = options.elevation_deg;
    settings.picture_size = options.size;
    const auto scalars = take.frame(take.frame_count() - 1).scalars;
    if (const auto found = scalars.find("shrinkage"); found != scalars.end())
        settings.final_shrinkage = found->second;
    if (options.colouring == Colouring::Material) return settings;
    // The same frames whatever is shown, so that a colour means the same in all pictures of a take.
    std::vector<std::vector<double>> sets;
    for (const int index : evenly_chosen(take.frame_count(), kScaleFrames)) {
        const take::Frame frame = take.frame(index);
        for (const auto& mesh : take.meshes())
            for (const auto& moved : frame.meshes)
                if (moved.name == mesh.name) sets.push_back(shown_values(options.colouring, mesh, moved));
    }
    settings.false_colour_scale = robust_magnitude(sets, kFalseColourFraction);
    return settings;
}

std::string title_of(const take::TakeInfo& info, Colouring colouring) {
    const std::string name = info.title.empty() ? info.name : info.title;
    switch (colouring) {
        case Colouring::Material:
            return name;
        case Colouring::Curvature:
            return name + " \u2013 mean curvature: red convex, blue concave";
        case Colouring::Depth:
            return name + " \u2013 depth: red ridges, blue valleys";
    }
    return name;
}

std::string caption_of(const take::Frame& frame) {
    const auto found = frame.scalars.find("shrinkage");
    return found == frame.scalars.end() ? fmt::format("time {:.2f}", frame.time)
                                        : fmt::format("shrinkage {:.2f}", found->second);
}

/// Progress of one picture as a part of all of them.
RunContext part_of(const RunContext& context, std::size_t done, std::size_t total,
                   std::chrono::steady_clock::time_point start) {
    RunContext part = context;
    part.on_progress = [&context, done, total, start](const Progress& p) {
        const double all = static_cast<double>(done) + p.done / p.total;
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        context.progress({"pictures", all, static_cast<double>(total),
                          all > 0 ? elapsed.count() * (static_cast<double>(total) - all) / all : -1,
                          fmt::format("picture {} of {}", done + 1, total)});
    };
    return part;
}

/// Renders shot after shot; what several shots of one frame share is made once.
class Photographer {
  public:
    Photographer(const take::TakeReader& take, const ShowOptions& options)
        : m_take(take), m_options(options), m_stage(take.meshes(), stage_settings(take, options)) {}

    Image8 shoot(Shot& shot, const RunContext& context) {
        if (shot.frame != m_frame.index || m_scene.meshes.empty()) {
            m_frame = m_take.frame(shot.frame);
            m_frame.index = shot.frame;
            m_scene = m_stage.scene_of(m_frame);
        }
        shot.caption = caption_of(m_frame);
        m_stage.aim(m_scene, shot.azimuth_deg);
        RenderSettings settings;
        settings.width = settings.height = m_options.size;
        settings.samples = m_options.samples;
        settings.denoise = m_options.denoise;
        const Image image = render(m_scene, settings, context);
        return to_srgb8(image,
                        m_options.colouring == Colouring::Material ? ToneCurve::Filmic : ToneCurve::Plain);
    }

  private:
    const take::TakeReader& m_take;
    const ShowOptions& m_options;
    Stage m_stage;
    take::Frame m_frame;
    Scene m_scene;
};

}  // namespace

ShowKind show_kind_named(const std::string& name) {
    return choice_named<ShowKind>("kind of picture", show_kind_names(), name);
}

const std::vector<std::string>& show_kind_names() {
    static const std::vector<std::string> names{"contact-sheet", "frame", "turntable", "time-lapse"};
    return names;
}

ShowOutput show_take(const take::TakeReader& take, const ShowOptions& options, const RunContext& context) {
    check(options, take.frame_count());
    const auto folder = options.output_folder.empty() ? take.folder() / "pictures" : options.output_folder;
    Plan plan = plan_of(options, folder, take.frame_count());
    const SheetLayout layout = sheet_layout(static_cast<int>(plan.shots.size()), options.size);
    if (!plan.sheet.empty() && static_cast<std::int64_t>(layout.width()) * layout.height() > kMostSheetPixels)
        throw InputError(
            fmt::format("a contact sheet of {} x {} pixels is too large; take a smaller size or fewer "
                        "frames",
                        layout.width(), layout.height()));
    if (!options.overwrite) refuse_existing(plan);
    Photographer photographer(take, options);
    take::make_writable_folder(plan.folder);

    ShowOutput output;
    std::vector<SheetCell> cells;
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < plan.shots.size(); ++i) {
        Shot& shot = plan.shots[i];
        Image8 picture = photographer.shoot(shot, part_of(context, i, plan.shots.size(), start));
        if (shot.file.empty()) {
            cells.push_back({std::move(picture), shot.caption});
        } else {
            take::write_whole_file(shot.file, encode_png(picture));
            output.pictures.push_back(shot.file);
        }
    }
    if (!plan.sheet.empty()) {
        take::write_whole_file(plan.sheet,
                               encode_png(contact_sheet(title_of(take.info(), options.colouring), cells)));
        output.pictures.push_back(plan.sheet);
    }
    if (!plan.movie.empty()) {
        if (make_movie(options.ffmpeg, plan.folder, static_cast<int>(plan.shots.size()),
                       options.frames_per_second, plan.movie, context))
            output.movie = plan.movie;
        else
            output.note = fmt::format(
                "no movie was made, since the program {} was not found; install ffmpeg, or put the pictures "
                "in {} together with another program",
                options.ffmpeg, plan.folder.string());
    }
    return output;
}

}  // namespace windfall::picture
