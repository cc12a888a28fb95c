#include "picture/show_take.h"

#include <fmt/format.h>

#include <chrono>

#include "core/error.h"
#include "picture/contact_sheet.h"
#include "picture/movie.h"
#include "picture/names.h"
#include "picture/path_tracer.h"
#include "picture/show_plan.h"
#include "picture/stage.h"
#include "take/whole_file.h"

namespace windfall::picture {
namespace {

constexpr std::int64_t kMostSheetPixels = 400'000'000;
/// Frames that decide about false colours, and about what a picture of moving wood must hold.
constexpr int kSampledFrames = 6;

StageSettings stage_settings(const take::TakeReader& take, const ShowOptions& options,
                             std::span<const take::Frame> sampled) {
    StageSettings settings;
    if (is_wood(take.meshes())) {
        if (!options.look.empty())
            throw InputError(
                fmt::format("{}: only fruit has a look; set the colours of wood in its recipe, "
                            "colours.*, and make the take again",
                            options.look.front().first));
    } else {
        settings.look = look_from_json(take.info().look);
        for (const auto& [key, value] : options.look) set_look(settings.look, key, value);
    }
    settings.colouring = options.colouring;
    settings.picture_size = options.size;
    const auto& scalars = sampled.back().scalars;
    if (const auto found = scalars.find("shrinkage"); found != scalars.end())
        settings.final_shrinkage = found->second;
    if (options.colouring == Colouring::Material) return settings;
    // The same frames whatever is shown, so that a colour means the same in all pictures of a take.
    std::vector<std::vector<double>> sets;
    for (const take::Frame& frame : sampled)
        for (const auto& mesh : take.meshes())
            for (const auto& moved : frame.meshes)
                if (moved.name == mesh.name) sets.push_back(shown_values(options.colouring, mesh, moved));
    settings.colour_range = colour_range(options.colouring, sets);
    return settings;
}

std::vector<take::Frame> sampled_frames(const take::TakeReader& take) {
    std::vector<take::Frame> frames;
    for (const int index : evenly_chosen(take.frame_count(), kSampledFrames))
        frames.push_back(take.frame_without_map_values(index));
    return frames;
}

Stage stage_for(const take::TakeReader& take, const ShowOptions& options) {
    const std::vector<take::Frame> sampled = sampled_frames(take);
    return Stage(take.meshes(), stage_settings(take, options, sampled), sampled);
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
        case Colouring::Tissue:
            return name + " \u2013 pith violet, heartwood red, sapwood yellow, phloem green, bark grey";
        case Colouring::Height:
            return name + " \u2013 height along the branch: low blue, high yellow";
        case Colouring::Moisture:
            return name + " \u2013 water under the skin: fresh blue, dry yellow";
    }
    return name;
}

std::string caption_of(const take::Frame& frame, bool wood) {
    if (wood) return fmt::format("{:.2f} s", frame.time);
    if (const auto hours = frame.scalars.find("hours"); hours != frame.scalars.end())
        return fmt::format("day {:.1f}", hours->second / 24);
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
        : m_take(take), m_options(options), m_stage(stage_for(take, options)) {}

    Image8 shoot(Shot& shot, const RunContext& context) {
        if (shot.frame != m_frame.index || m_scene.meshes.empty()) {
            m_frame = m_take.frame(shot.frame);
            m_frame.index = shot.frame;
            if (m_options.dress && m_options.colouring == Colouring::Material) m_options.dress(m_frame);
            m_scene = m_stage.scene_of(m_frame);
        }
        if (shot.caption.empty()) shot.caption = caption_of(m_frame, is_wood(m_take.meshes()));
        m_stage.aim(m_scene, shot.azimuth_deg, shot.elevation_deg, shot.view, shot.framing);
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

View view_named(const std::string& name) { return choice_named<View>("view", view_names(), name); }

const std::vector<std::string>& view_names() {
    static const std::vector<std::string> names{"whole", "break"};
    return names;
}

ShowOutput show_take(const take::TakeReader& take, const ShowOptions& options, const RunContext& context) {
    const auto folder = options.output_folder.empty() ? take.folder() / "pictures" : options.output_folder;
    ShowPlan plan = plan_show(options, folder, take.frame_count(), is_wood(take.meshes()));
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
