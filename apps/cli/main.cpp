// The program `windfall`: arguments in, exit code out.
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#include "cancelled_run.h"
#include "commands.h"
#include "core/error.h"
#include "core/version.h"
#include "exit_codes.h"

namespace {

/// "windfall: error: ..."; the lines of a longer message stand below each other.
int report(const std::exception& error, int exit_code) {
    std::fprintf(stderr, "windfall: error: %s\n", error.what());
    return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
    using namespace windfall;
    // A write beyond the limit on the size of files then fails with EFBIG, which is told, and kills nobody.
    std::signal(SIGXFSZ, SIG_IGN);
    CLI::App app(
        "Windfall ages plants on a computer: it dries fruit until the skin wrinkles, and breaks branches.");
    app.name("windfall");
    app.set_version_flag("--version", "windfall " + program_version());
    app.require_subcommand(1);
    app.footer(
        "Examples:\n"
        "  windfall dry jujube                      dry a shipped fruit; leaves jujube-seed1.take\n"
        "  windfall snap ailanthus                  break a shipped branch; leaves ailanthus-seed1.take\n"
        "  windfall presets                         what is shipped\n"
        "  windfall presets jujube > my.toml        a recipe of your own to begin from\n"
        "  windfall show jujube-seed1.take          pictures of a take\n"
        "`windfall COMMAND --help` tells more. Exit codes: 0 done, 1 failed while running, 2 wrong input, "
        "130 cancelled.");
    cli::add_dry(app);
    cli::add_snap(app);
    cli::add_rot(app);
    cli::add_show(app);
    cli::add_export(app);
    cli::add_measure(app);
    cli::add_presets(app);
    cli::add_schema(app);
    cli::add_doctor(app);
    try {
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::Success& success) {  // --help, --version
        return app.exit(success);
    } catch (const CLI::ParseError& error) {
        std::fprintf(
            stderr,
            "windfall: error: %s; `windfall --help` and `windfall COMMAND --help` list what there is\n",
            error.what());
        return cli::kExitWrongInput;
    } catch (const InputError& error) {
        return report(error, cli::kExitWrongInput);
    } catch (const Cancelled&) {
        std::fprintf(stderr, "windfall: cancelled\n");
        return cli::kExitCancelled;
    } catch (const cli::CancelledRun& cancelled) {
        std::fprintf(stderr, "windfall: %s\n", cancelled.what());
        return cli::kExitCancelled;
    } catch (const std::exception& error) {
        return report(error, cli::kExitFailed);
    }
}
