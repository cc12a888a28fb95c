#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "cancel.h"
#include "commands.h"
#include "core/parallel.h"
#include "picture/show_take.h"
#include "progress.h"
#include "recipe/dressing.h"
#include "recipe/look_setting.h"

namespace windfall::cli {
namespace {

struct ShowOptions {
    std::string take;
    std::string output;
    std::string kind = "contact-sheet";
    std::string colouring = "material";
    std::string view;
    std::vector<std::string> settings;
    std::string progress;
    int threads = 0;
    picture::ShowOptions show;
};

void show(ShowOptions options) {
    const ThreadLimit threads(options.threads);
    const std::unique_ptr<ProgressPrinter> printer = make_progress_printer(options.progress);
    options.show.kind = picture::show_kind_named(options.kind);
    options.show.colouring = picture::colouring_named(options.colouring);
    if (!options.view.empty()) options.show.view = picture::view_named(options.view);
    options.show.output_folder = options.output.empty() ? std::filesystem::path(options.take) / "pictures"
                                                        : std::filesystem::path(options.output);
    for (const std::string& setting : options.settings)
        options.show.look.push_back(recipe::parse_look_setting(setting));
    RunContext context;
    context.cancel = &cancel_on_signals();
    context.on_progress = [&](const Progress& progress) { printer->progress(progress); };
    const take::TakeReader take(options.take);
    options.show.dress = recipe::dressing(take);
    const picture::ShowOutput output = picture::show_take(take, options.show, context);
    if (!output.note.empty()) printer->warning(output.note);
    // Of a movie's many frames only the movie is worth naming.
    std::vector<std::filesystem::path> results = output.pictures;
    if (!output.movie.empty()) results = {output.movie};
    printer->done(options.take, results);
}

}  // namespace

void add_show(CLI::App& app) {
    CLI::App* command = app.add_subcommand("show", "Make pictures of a take");
    const auto options = std::make_shared<ShowOptions>();
    picture::ShowOptions& show_options = options->show;
    command->add_option("TAKE", options->take, "The take's folder")->required();
    command->add_option("--kind", options->kind, "contact-sheet, frame, turntable or time-lapse")
        ->type_name("KIND");
    command
        ->add_option("--colour", options->colouring,
                     "material; or curvature, depth, moisture, tissue or height in colours")
        ->type_name("WHAT");
    command->add_option("--view", options->view, "Of a branch: break (the broken end) or whole")
        ->type_name("VIEW");
    command->add_option("-o,--output", options->output, "Folder for the pictures; TAKE/pictures when absent")
        ->type_name("DIR");
    command->add_option("--frame", show_options.frame, "Which frame a frame or turntable shows; -1: the last")
        ->type_name("N");
    command->add_option("--size", show_options.size, "Pixels along a side of one picture")->type_name("N");
    command->add_option("--samples", show_options.samples, "Paths a pixel: more is slower and smoother")
        ->type_name("N");
    command->add_option("--azimuth", show_options.azimuth_deg, "Camera about the vertical axis, degrees")
        ->type_name("DEG");
    command->add_option("--elevation", show_options.elevation_deg, "Camera above the horizon, degrees")
        ->type_name("DEG");
    command->add_option("--sheet-frames", show_options.sheet_frames, "Most frames on a contact sheet")
        ->type_name("N");
    command->add_option("--views", show_options.turntable_views, "Pictures of a whole turn")->type_name("N");
    command->add_option("--fps", show_options.frames_per_second, "Frames a second of a movie")
        ->type_name("N");
    command->add_flag("!--no-denoise", show_options.denoise, "Leave the noise in");
    command->add_option("--set", options->settings, "Change the look for these pictures: look.gloss=0.2")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    command->add_flag("--force", show_options.overwrite, "Replace pictures that are there");
    command->add_option("--threads", options->threads, "0: all there are")
        ->check(CLI::Range(0, 4096))
        ->type_name("N");
    command->add_option("--progress", options->progress, "bar, plain or json")
        ->check(CLI::IsMember(progress_kinds()))
        ->type_name("KIND");
    command->footer(
        "Examples:\n"
        "  windfall show jujube-seed1.take\n"
        "  windfall show jujube-seed1.take --kind turntable --size 720 -o movie\n"
        "  windfall show jujube-seed1.take --kind frame --frame 3 --colour curvature\n"
        "  windfall show plum-seed1.take --set look.bloom=0.6 --force\n"
        "  windfall show ailanthus-seed1.take --kind frame --view break --size 1080 -o closer\n"
        "Movies need ffmpeg; without it the single pictures are made all the same.");
    command->callback([options] { show(*options); });
}

}  // namespace windfall::cli
