#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <optional>

#include "cancel.h"
#include "cancelled_run.h"
#include "commands.h"
#include "core/parallel.h"
#include "drying/drying_process.h"
#include "exit_codes.h"
#include "parameter_text.h"
#include "picture/show_take.h"
#include "progress.h"
#include "recipe/recipe.h"
#include "recipe/run_recipe.h"

namespace windfall::cli {
namespace {

namespace fs = std::filesystem;

struct DryOptions {
    std::string recipe;
    std::vector<std::string> settings;
    std::string output;
    std::string progress;
    std::optional<std::int64_t> seed;
    int threads = 0;
    bool resume = false, force = false, no_pictures = false, dry_run = false;
};

void print_plan(const recipe::Recipe& recipe, const drying::Plan& plan, const fs::path& folder) {
    const double te = recipe.drying.fruit.skin_thickness;
    fmt::print("recipe       {} ({})\n", recipe.name, recipe.title);
    fmt::print("mesh         {} x {} x {} brick, {} layers\n", plan.n, plan.n_axial, plan.n, plan.layers);
    fmt::print("unknowns     {}\n", plan.unknowns);
    fmt::print("wave length  about {:.3g} r_1, {:.3g} t_e; {:.3g} elements a wave\n",
               plan.expected_wave_length, plan.expected_wave_length / te, plan.elements_per_wave);
    fmt::print("frames       {}\n", drying::frame_shrinkages(recipe.drying).size());
    fmt::print("take         {}\n", folder.string());
}

take::TakeWriter open_take(const DryOptions& options, const recipe::Recipe& recipe, const fs::path& folder) {
    const take::TakeInfo info = recipe::take_info(recipe);
    return options.resume ? take::TakeWriter::resume(folder, info)
                          : take::TakeWriter::create(folder, info, options.force);
}

/// The contact sheet, in a folder of its own so that the take's files stay apart.
std::vector<fs::path> draw(const DryOptions& options, const fs::path& folder, const RunContext& context) {
    picture::ShowOptions show;
    show.output_folder = folder / "pictures";
    // In a fresh take there is nothing to replace; the others were asked for.
    show.overwrite = options.resume || options.force;
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

void run_take(const DryOptions& options, const recipe::Recipe& recipe, const fs::path& folder,
              RunContext context, ProgressPrinter& printer) {
    take::TakeWriter writer = open_take(options, recipe, folder);
    context.on_log = [&](const std::string& line) { writer.log(line); };
    try {
        recipe::run(recipe, writer, context, [&](const take::Frame& frame) { printer.frame(frame); });
    } catch (const Cancelled&) {
        throw CancelledRun(fmt::format("cancelled; go on with `windfall dry {} -o {} --resume`",
                                       shell_text(folder / "recipe.toml"), shell_text(folder)));
    }
}

void run_and_draw(const DryOptions& options, const recipe::Recipe& recipe, const fs::path& folder,
                  ProgressPrinter& printer) {
    RunContext context;
    context.cancel = &cancel_on_signals();
    context.on_progress = [&](const Progress& progress) { printer.progress(progress); };
    // A complete take may lack no more than its pictures.
    if (!options.resume || !recipe::is_complete(recipe, folder))
        run_take(options, recipe, folder, context, printer);
    std::vector<fs::path> pictures;
    try {
        if (!options.no_pictures) pictures = draw(options, folder, context);
    } catch (const Cancelled&) {
        throw CancelledRun(
            fmt::format("cancelled; the take is complete, `windfall show {}` draws it", shell_text(folder)));
    }
    printer.done(folder, pictures);
}

void dry(const DryOptions& options) {
    const ThreadLimit threads(options.threads);
    std::vector<std::string> settings = options.settings;
    if (options.seed) settings.push_back(fmt::format("seed={}", *options.seed));
    const std::unique_ptr<ProgressPrinter> printer = make_progress_printer(options.progress);
    try {
        const recipe::Recipe recipe = recipe::load(options.recipe, settings);
        const fs::path folder = options.output.empty()
                                    ? fs::path(fmt::format("{}-seed{}.take", recipe.name, recipe.drying.seed))
                                    : fs::path(options.output);
        const drying::Plan plan = drying::plan(recipe.drying);
        for (const std::string& warning : plan.warnings) printer->warning(warning);
        if (options.dry_run) return print_plan(recipe, plan, folder);
        run_and_draw(options, recipe, folder, *printer);
    } catch (const InputError& error) {
        printer->error(error.what(), kExitWrongInput);
        throw;
    } catch (const CancelledRun& error) {
        printer->error(error.what(), kExitCancelled);
        throw;
    } catch (const std::exception& error) {
        printer->error(error.what(), kExitFailed);
        throw;
    }
}

}  // namespace

void add_dry(CLI::App& app) {
    CLI::App* command = app.add_subcommand("dry", "Dry a fruit until its skin wrinkles, into a take folder");
    const auto options = std::make_shared<DryOptions>();
    command->add_option("RECIPE", options->recipe, "A preset's name, or the path of a recipe file (.toml)")
        ->required();
    // One value each, so that the recipe may stand behind it.
    command->add_option("--set", options->settings, "Set a parameter; may be given several times")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    command->add_option("-o,--output", options->output, "The take's folder; NAME-seedN.take when absent")
        ->type_name("DIR");
    command->add_option("--seed", options->seed, "The same as --set seed=N")->type_name("N");
    auto* resume = command->add_flag("--resume", options->resume,
                                     "Go on with the take in that folder, from its last checkpoint");
    command->add_flag("--force", options->force, "Replace the take in that folder")->excludes(resume);
    command
        ->add_option("--progress", options->progress,
                     "How to tell of the run: bar (on a terminal), plain, json (one object a line on stdout)")
        ->check(CLI::IsMember(progress_kinds()))
        ->type_name("KIND");
    command->add_option("--threads", options->threads, "0: all there are; the result does not depend on it")
        ->check(CLI::Range(0, 4096))
        ->type_name("N");
    command->add_flag("--no-pictures", options->no_pictures, "Leave out the contact sheet");
    command->add_flag("--dry-run", options->dry_run, "Only print what would be solved, with warnings");
    command->add_flag_callback(
        "--help-parameters",
        [] {
            fmt::print("{}", parameter_reference());
            throw CLI::Success();
        },
        "List every parameter (the same as `windfall schema`)");
    command->footer(
        "Examples:\n"
        "  windfall dry jujube\n"
        "  windfall dry sphere --set material.gamma=20 --seed 7 -o stiff.take\n"
        "  windfall dry my.toml --dry-run\n"
        "  windfall dry plum --set output.shrinkages=[0.1,0.2,0.3] --no-pictures\n"
        "  windfall dry jujube-seed1.take/recipe.toml -o jujube-seed1.take --resume\n"
        "`windfall schema` lists every parameter, `windfall presets` every preset.");
    command->callback([options] { dry(*options); });
}

}  // namespace windfall::cli
