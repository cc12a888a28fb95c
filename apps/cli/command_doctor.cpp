#include <embree3/rtcore_config.h>
#include <fmt/format.h>
#include <oneapi/tbb/version.h>
#include <spng.h>
#include <toml++/toml.h>
#include <zstd.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "core/version.h"
#include "drying/kernels/kernels.h"
#include "machine.h"
#include "recipe/presets.h"

namespace windfall::cli {
namespace {

void line(const std::string& what, const std::string& value) { fmt::print("{:<16} {}\n", what, value); }

std::string features_text() {
    const bool avx2 = __builtin_cpu_supports("avx2") != 0, avx512 = __builtin_cpu_supports("avx512f") != 0;
    return avx512 ? "AVX2 and AVX-512" : avx2 ? "AVX2" : "none of AVX2 and AVX-512";
}

void print_program(const std::string& name, const std::string& purpose) {
    const auto path = find_program(name);
    line(name, path.empty() ? "not there: " + purpose : path.string());
}

void doctor() {
    line("windfall", program_version());
    line("compiler", fmt::format("GCC {}", __VERSION__));
    line("processor", processor_name());
    line("vectors", features_text());
    line("kernels", drying::kernels(8).instruction_set);
    line("threads", fmt::format("{}", usable_threads()));
    const auto memory = available_memory_bytes();
    line("memory", memory ? bytes_text(*memory) + " available" : "unknown");
    std::error_code error;
    const auto space = std::filesystem::space(".", error);
    line("disk",
         error ? "unknown: " + error.message() : bytes_text(space.available) + " free in this folder");
    line("presets", recipe::preset_folder().string());
    fmt::print("\n");
    line("Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION));
    line("oneTBB", TBB_runtime_version());
    line("Embree", RTC_VERSION_STRING);
    line("toml++", fmt::format("{}.{}.{}", TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH));
    line("nlohmann-json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                      NLOHMANN_JSON_VERSION_PATCH));
    line("fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100));
    line("CLI11", CLI11_VERSION);
    line("zstd", ZSTD_versionString());
    line("libspng", spng_version_string());
    fmt::print("\n");
    print_program("ffmpeg", "needed for movies (`windfall show --kind turntable`); Debian package ffmpeg");
    print_program("ccx", "CalculiX, needed by slow tests only; Debian package calculix-ccx");
}

}  // namespace

void add_doctor(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("doctor", "Tell about this machine: versions, processor, memory, helper programs");
    command->footer("Example:\n  windfall doctor        what to send along with a report of a fault");
    command->callback(doctor);
}

}  // namespace windfall::cli
