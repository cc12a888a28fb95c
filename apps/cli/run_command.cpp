#include "run_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>

#include "cancel.h"
#include "cancelled_run.h"
#include "core/parallel.h"
#include "exit_codes.h"
#include "parameter_text.h"
#include "picture/show_take.h"
#include "progress.h"
#include "recipe/process.h"
#include "recipe/run_recipe.h"

namespace windfall::cli {
namespace {

namespace fs = std::filesystem;

void print_plan(const recipe::Recipe& recipe, const recipe::RunPlan& plan, const fs::path& folder) {
    const auto line = [](const std::string& what, const std::string& text) {
        fmt::print("{:<12} {}\n", what, text);
    };
    line("recipe", fmt::format("{} ({})", recipe.name, recipe.title));
    for (const auto& [what, text] : plan.lines) line(what, text);
    line("take", folder.string());
}

take::TakeWriter open_take(const RunOptions& options, const recipe::Recipe& recipe, const fs::path& folder) {
    const take::TakeInfo info = recipe::take_info(recipe);
    return options.resume ? take::TakeWriter::resume(folder, info)
                          : take::TakeWriter::create(folder, info, options.force);
}

/// The contact sheet, in a folder of its own so that the take's files stay apart.
std::vector<fs::path> draw(const RunOptions& options, const recipe::Recipe& recipe, const fs::path& folder,
                           const RunContext& context) {
    picture::ShowOptions show;
    show.output_folder = folder / "pictures";
    // In a fresh take there is nothing to replace; the others were asked for.
    show.overwrite = options.resume || options.force;
    // A take that was complete already may hold another look than the one asked for now.
    for (const auto& parameter : recipe::process_named(recipe.process).look)
        show.look.emplace_back(parameter.info.key, parameter.get(recipe));
    return picture::show_take(take::TakeReader(folder), show, context).pictures;
}

/// Text of a path in a command to be pasted into a shell.
std::string shell_text(const fs::path& path) {
    const std::string text = path.string();
    const bool plain = std::all_of(text.begin(), text.end(), [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
               std::string("-_./+=@").find(c) != std::string::npos;
    });
    if (plain) return text;
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

void run_take(const RunOptions& options, const recipe::Recipe& recipe, const fs::path& folder,
              RunContext context, ProgressPrinter& printer) {
    take::TakeWriter writer = open_take(options, recipe, folder);
    context.on_log = [&](const std::string& line) { writer.log(line); };
    try {
        recipe::run(recipe, writer, context, [&](const take::Frame& frame) { printer.frame(frame); });
    } catch (const Cancelled&) {
        throw CancelledRun(fmt::format("cancelled; go on with `windfall {} {} -o {} --resume`",
                                       recipe::process_named(recipe.process).command,
                                       shell_text(folder / "recipe.toml"), shell_text(folder)));
    }
}

void run_and_draw(const RunOptions& options, const recipe::Recipe& recipe, const fs::path& folder,
                  ProgressPrinter& printer) {
    RunContext context;
    context.cancel = &cancel_on_signals();
    context.on_progress = [&](const Progress& progress) { printer.progress(progress); };
    // A complete take may lack no more than its pictures.
    if (!options.resume || !recipe::is_complete(recipe, folder))
        run_take(options, recipe, folder, context, printer);
    std::vector<fs::path> pictures;
    try {
        if (!options.no_pictures) pictures = draw(options, recipe, folder, context);
    } catch (const Cancelled&) {
        throw CancelledRun(
            fmt::format("cancelled; the take is complete, `windfall show {}` draws it", shell_text(folder)));
    }
    printer.done(folder, pictures);
}

void check_process(const RunOptions& options, const recipe::Recipe& recipe, const std::string& process) {
    if (recipe.process == process) return;
    throw InputError(fmt::format("{} is a recipe of the process \"{}\", which is run with `windfall {} {}`",
                                 options.recipe, recipe.process,
                                 recipe::process_named(recipe.process).command, shell_text(options.recipe)));
}

}  // namespace

std::vector<std::string> RunOptions::all_settings() const {
    std::vector<std::string> result = settings;
    if (seed) result.push_back(fmt::format("seed={}", *seed));
    return result;
}

void add_run_options(CLI::App& command, RunOptions& options, const std::string& process) {
    command.add_option("RECIPE", options.recipe, "A preset's name, or the path of a recipe file (.toml)")
        ->required();
    // One value each, so that the recipe may stand behind it.
    command.add_option("--set", options.settings, "Set a parameter; may be given several times")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    command.add_option("-o,--output", options.output, "The take's folder; NAME-seedN.take when absent")
        ->type_name("DIR");
    command.add_option("--seed", options.seed, "The same as --set seed=N")->type_name("N");
    auto* resume = command.add_flag("--resume", options.resume,
                                    "Go on with the take in that folder, from its last checkpoint");
    command.add_flag("--force", options.force, "Replace the take in that folder")->excludes(resume);
    command
        .add_option("--progress", options.progress,
                    "How to tell of the run: bar (on a terminal), plain, json (one object a line on stdout)")
        ->check(CLI::IsMember(progress_kinds()))
        ->type_name("KIND");
    command.add_option("--threads", options.threads, "0: all there are; the result does not depend on it")
        ->check(CLI::Range(0, 4096))
        ->type_name("N");
    command.add_flag("--no-pictures", options.no_pictures, "Leave out the contact sheet");
    command.add_flag("--dry-run", options.dry_run, "Only print what would be run, with warnings");
    command.add_flag_callback(
        "--help-parameters",
        [process] {
            fmt::print("{}", parameter_reference(recipe::process_named(process)));
            throw CLI::Success();
        },
        fmt::format("List every parameter (the same as `windfall schema {}`)", process));
}

void run_recipe(const RunOptions& options, const std::string& process) {
    const ThreadLimit threads(options.threads);
    run_and_report(options.progress, [&](ProgressPrinter& printer) {
        const recipe::Recipe recipe = recipe::load(options.recipe, options.all_settings());
        check_process(options, recipe, process);
        const fs::path folder =
            options.output.empty()
                ? fs::path(fmt::format("{}-seed{}.take", recipe.name, recipe::seed_of(recipe)))
                : fs::path(options.output);
        const recipe::RunPlan plan = recipe::process_named(process).plan(recipe);
        for (const std::string& warning : plan.warnings) printer.warning(warning);
        if (options.dry_run)
            print_plan(recipe, plan, folder);
        else
            run_and_draw(options, recipe, folder, printer);
    });
}

void run_and_report(const std::string& progress_kind, const std::function<void(ProgressPrinter&)>& run) {
    const std::unique_ptr<ProgressPrinter> printer = make_progress_printer(progress_kind);
    try {
        run(*printer);
    } catch (const InputError& error) {
        printer->error(error.what(), kExitWrongInput);
        throw;
    } catch (const CancelledRun& error) {
        printer->error(error.what(), kExitCancelled);
        throw;
    } catch (const Cancelled& error) {
        printer->error(error.what(), kExitCancelled);
        throw;
    } catch (const std::exception& error) {
        printer->error(error.what(), kExitFailed);
        throw;
    }
}

}  // namespace windfall::cli
