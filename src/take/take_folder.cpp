#include "take/take_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "core/error.h"
#include "take/map_file.h"
#include "take/whole_file.h"

namespace windfall::take {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFormat = "windfall-take";
constexpr int kFormatVersion = 1;
constexpr std::array<const char*, 4> kStatusNames = {"running", "complete", "cancelled", "failed"};

TakeStatus status_from(const std::string& text) {
    for (std::size_t i = 0; i < kStatusNames.size(); ++i)
        if (text == kStatusNames[i]) return static_cast<TakeStatus>(i);
    throw InputError(fmt::format("'{}' is no status of a take", text));
}

TakeHeader header_from(const nlohmann::json& json) {
    if (json.at("format") != kFormat) throw InputError("it is not of the format windfall-take");
    if (const int version = json.at("format_version").get<int>(); version != kFormatVersion)
        throw InputError(
            fmt::format("it has version {} of the format, this program reads version {}; "
                        "take the program that wrote it",
                        version, kFormatVersion));
    TakeHeader header;
    auto& info = header.info;
    info.process = json.at("process").get<std::string>();
    info.name = json.at("name").get<std::string>();
    info.title = json.at("title").get<std::string>();
    info.program_version = json.at("program_version").get<std::string>();
    info.seed = json.at("seed").get<std::uint64_t>();
    info.unit_length_m = json.at("unit_length_m").get<double>();
    info.parameters = json.at("parameters");
    info.look = json.at("look");
    header.status = status_from(json.at("status").get<std::string>());
    header.reason = json.at("reason").get<std::string>();
    header.mesh_names = json.at("meshes").get<std::vector<std::string>>();
    if (!(info.unit_length_m > 0)) throw InputError("unit_length_m must be > 0");
    for (const auto& name : header.mesh_names)
        if (!is_mesh_name(name)) throw InputError(fmt::format("'{}' cannot be the name of a mesh", name));
    return header;
}

void remove_file(const fs::path& path) {
    std::error_code problem;
    fs::remove(path, problem);
    if (problem)
        throw RunError(fmt::format("cannot remove {}: {}; remove it by hand and {}", path.string(),
                                   problem.message(), kRunAgain));
}

}  // namespace

const char* to_text(TakeStatus status) { return kStatusNames.at(static_cast<std::size_t>(status)); }

fs::path mesh_path(const fs::path& folder, const std::string& name) {
    return folder / "meshes" / (name + ".wfa");
}
fs::path frame_path(const fs::path& folder, int index) {
    return folder / "frames" / fmt::format("frame_{:04}.wfa", index);
}
fs::path checkpoint_path(const fs::path& folder) { return folder / "checkpoint.wfa"; }
fs::path recipe_path(const fs::path& folder) { return folder / "recipe.toml"; }
fs::path summary_path(const fs::path& folder) { return folder / "summary.json"; }

bool is_mesh_name(const std::string& name) {
    const auto allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-';
    };
    return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), allowed);
}

bool has_header(const fs::path& folder) {
    std::error_code problem;
    return fs::exists(folder / "take.json", problem);
}

TakeHeader read_header(const fs::path& folder) {
    if (!has_header(folder)) {
        std::error_code problem;
        const char* what = fs::exists(folder, problem) ? "no take.json in it" : "there is no such folder";
        throw InputError(fmt::format("{} is not a take: {}; makes one: windfall dry sphere -o {}",
                                     folder.string(), what, folder.string()));
    }
    const fs::path path = folder / "take.json";
    try {
        TakeHeader header = header_from(nlohmann::json::parse(read_whole_text(path, kMaxTextBytes)));
        std::error_code problem;
        if (const fs::path recipe = recipe_path(folder); fs::exists(recipe, problem))
            header.info.recipe_text = read_whole_text(recipe, kMaxTextBytes);
        return header;
    } catch (const nlohmann::json::exception& problem) {
        throw InputError(
            fmt::format("{} is not a take: its take.json is damaged ({})", folder.string(), problem.what()));
    } catch (const InputError& problem) {
        throw InputError(
            fmt::format("{} is not a take that can be read: {}", folder.string(), problem.what()));
    }
}

void write_header(const fs::path& folder, const TakeHeader& header, std::string_view how_to_go_on) {
    const auto& info = header.info;
    const nlohmann::ordered_json json = {{"format", kFormat},
                                         {"format_version", kFormatVersion},
                                         {"status", to_text(header.status)},
                                         {"reason", header.reason},
                                         {"process", info.process},
                                         {"name", info.name},
                                         {"title", info.title},
                                         {"program_version", info.program_version},
                                         {"seed", info.seed},
                                         {"unit_length_m", info.unit_length_m},
                                         {"meshes", header.mesh_names},
                                         {"parameters", nlohmann::ordered_json(info.parameters)},
                                         {"look", nlohmann::ordered_json(info.look)}};
    write_whole_file(folder / "take.json",
                     json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n",
                     how_to_go_on);
}

ArrayFile read_array_file(const fs::path& path) {
    constexpr std::uint64_t kMaxBytes = std::uint64_t{8} << 30;
    return decode_array_file(read_whole_file(path, kMaxBytes), path.string());
}

bool has_checkpoint(const fs::path& folder) {
    std::error_code problem;
    return fs::exists(checkpoint_path(folder), problem);
}

std::vector<std::byte> read_checkpoint(const fs::path& folder) {
    const fs::path path = checkpoint_path(folder);
    const ArrayFile file = read_array_file(path);
    const auto bytes =
        std::as_bytes(std::span(required_array<std::uint8_t>(file, "checkpoint", {0}, path.string())));
    return {bytes.begin(), bytes.end()};
}

std::vector<fs::path> folder_entries(const fs::path& folder) {
    std::vector<fs::path> paths;
    std::error_code problem;
    for (fs::directory_iterator it(folder, problem), end; !problem && it != end; it.increment(problem))
        paths.push_back(it->path());
    return paths;
}

std::vector<int> frame_indices(const fs::path& folder) {
    std::vector<int> indices;
    for (const auto& path : folder_entries(folder / "frames")) {
        const std::string name = path.filename().string();
        if (!name.starts_with("frame_") || name.size() > 20) continue;
        const int index = std::atoi(name.c_str() + 6);
        if (index >= 0 && frame_path(folder, index).filename() == name) indices.push_back(index);
    }
    std::sort(indices.begin(), indices.end());
    return indices;
}

void remove_run(const fs::path& folder) {
    remove_file(checkpoint_path(folder));
    remove_file(summary_path(folder));
    remove_file(folder / "log.txt");
    for (const int index : frame_indices(folder)) remove_file(frame_path(folder, index));
    remove_maps(folder);
    for (const auto& path : folder_entries(folder / "meshes"))
        if (path.extension() == ".wfa" && is_mesh_name(path.stem().string())) remove_file(path);
}

void remove_temporaries(const fs::path& folder) {
    for (const auto& place : {folder, folder / "frames", folder / "meshes"})
        for (const auto& path : folder_entries(place))
            if (is_temporary_name(path.filename().string())) remove_file(path);
    remove_map_temporaries(folder);
}

}  // namespace windfall::take
