#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "cancel.h"
#include "commands.h"
#include "export/export_take.h"
#include "progress.h"

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

void export_formats(const ExportOptions& options) {
    const std::unique_ptr<ProgressPrinter> printer = make_progress_printer(options.progress);
    std::vector<export_::ExportFormat> formats;
    for (const std::string& name : options.formats) formats.push_back(export_::export_format(name));
    const take::TakeReader take(options.take);
    RunContext context;
    context.cancel = &cancel_on_signals();
    context.on_progress = [&](const Progress& progress) { printer->progress(progress); };
    export_::ExportOptions settings;
    settings.output = options.output.empty() ? std::filesystem::path(options.take) / "export"
                                             : std::filesystem::path(options.output);
    if (formats.size() > 1 && settings.output.has_extension()) {
        // A file takes one format only; say so before the first is written.
        const std::string extension = settings.output.extension().string().substr(1);
        const auto& names = export_::export_format_names();
        if (std::find(names.begin(), names.end(), extension) != names.end())
            throw InputError(
                fmt::format("-o {}: several formats go into a folder, not into one file", options.output));
    }
    settings.frame = options.frame;
    settings.scale = options.scale;
    settings.overwrite = options.force;
    settings.frames_per_second = options.frames_per_second;
    std::vector<std::filesystem::path> files;
    for (const auto format : formats) {
        settings.format = format;
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
                     fmt::format("One or more of {}", fmt::join(export_::export_format_names(), ",")))
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
        "  windfall export jujube-seed1.take --to obj --scale 100 -o frames");
    command->callback([options] { export_formats(*options); });
}

}  // namespace windfall::cli
