#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "cancel.h"
#include "commands.h"
#include "export/export_take.h"
#include "progress.h"
#include "recipe/dressing.h"
#include "recipe/export_calculix.h"

namespace windfall::cli {
namespace {

struct ExportOptions {
    std::string take;
    std::vector<std::string> formats;
    std::string output;
    std::string progress;
    std::optional<int> frame;
    double scale = 1;
    double frames_per_second = 24;
    bool force = false;
};

/// What a take was made from, for CalculiX; all other formats are of its frames.
const std::string kCalculix = "inp";

std::vector<std::string> format_names() {
    std::vector<std::string> names = export_::export_format_names();
    names.push_back(kCalculix);
    return names;
}

void check_formats(const ExportOptions& options) {
    const std::vector<std::string> known = format_names();
    const auto is_known = [&](const std::string& name) {
        return std::find(known.begin(), known.end(), name) != known.end();
    };
    for (const std::string& name : options.formats)
        if (!is_known(name))
            throw InputError(
                fmt::format("'{}' is no export format; there are {}", name, fmt::join(known, ", ")));
    const std::string extension = std::filesystem::path(options.output).extension().string();
    if (extension.empty() || !is_known(extension.substr(1))) return;
    // A file takes one format only; say so before the first is written.
    if (options.formats.size() > 1)
        throw InputError(
            fmt::format("-o {}: several formats go into a folder, not into one file", options.output));
    if (extension.substr(1) != options.formats.front())
        throw InputError(fmt::format("{} does not end in .{}; change the name, or the format to --to {}",
                                     options.output, options.formats.front(), extension.substr(1)));
}

void export_formats(const ExportOptions& options) {
    const std::unique_ptr<ProgressPrinter> printer = make_progress_printer(options.progress);
    check_formats(options);
    const take::TakeReader take(options.take);
    RunContext context;
    context.cancel = &cancel_on_signals();
    context.on_progress = [&](const Progress& progress) { printer->progress(progress); };
    export_::ExportOptions settings;
    settings.output = options.output.empty() ? std::filesystem::path(options.take) / "export"
                                             : std::filesystem::path(options.output);
    settings.frame = options.frame;
    settings.scale = options.scale;
    settings.overwrite = options.force;
    settings.frames_per_second = options.frames_per_second;
    settings.dress = recipe::dressing(take);
    std::vector<std::filesystem::path> files;
    for (const std::string& name : options.formats) {
        if (name == kCalculix) {
            files.push_back(recipe::export_calculix(options.take, settings.output, options.force, context));
            continue;
        }
        settings.format = export_::export_format(name);
        for (const auto& file : export_::export_take(take, settings, context)) files.push_back(file);
    }
    for (const auto& file : files) fmt::print("{}\n", file.string());
}

}  // namespace

void add_export(CLI::App& app) {
    CLI::App* command = app.add_subcommand("export", "Write a take's frames for other programs");
    const auto options = std::make_shared<ExportOptions>();
    command->add_option("TAKE", options->take, "The take's folder")->required();
    command
        ->add_option("--to", options->formats,
                     fmt::format("One or more of {}", fmt::join(format_names(), ",")))
        ->required()
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("FORMAT,...");
    command->add_option("-o,--output", options->output, "A file or a folder; TAKE/export when absent")
        ->type_name("PATH");
    command->add_option("--frame", options->frame, "Only this frame; all when absent (glb: as an animation)")
        ->type_name("N");
    command->add_option("--scale", options->scale, "Times the real size; lengths are metres")
        ->type_name("FACTOR");
    command->add_option("--fps", options->frames_per_second, "Frames a second of an animation")
        ->type_name("N");
    command->add_flag("--force", options->force, "Replace files that are there");
    command->add_option("--progress", options->progress, "bar or plain")
        ->check(CLI::IsMember({"bar", "plain"}))
        ->type_name("KIND");
    command->footer(
        "Examples:\n"
        "  windfall export jujube-seed1.take --to glb -o jujube.glb\n"
        "  windfall export jujube-seed1.take --to obj,ply --frame 6\n"
        "  windfall export jujube-seed1.take --to obj --scale 100 -o frames\n"
        "  windfall export orange-seed1.take --to maps --frame 200\n"
        "  windfall export jujube-seed1.take --to inp       the recipe as a CalculiX deck");
    command->callback([options] { export_formats(*options); });
}

}  // namespace windfall::cli
