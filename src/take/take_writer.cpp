#include "take/take_writer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <stdexcept>

#include "core/error.h"
#include "take/array_file.h"
#include "take/frame_file.h"
#include "take/map_file.h"
#include "take/whole_file.h"

namespace windfall::take {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kResume = "run again with --resume";

// Throws unless a new take may begin in `folder`. Returns whether there is a take to replace.
bool check_place(const fs::path& folder, bool replace_existing) {
    if (has_header(folder)) {
        if (!replace_existing)
            throw InputError(
                fmt::format("{} holds a take already; add --resume to go on with it, --force to replace "
                            "it, or choose another folder with -o",
                            folder.string()));
        read_header(folder);  // never removes what only looks like a take
        return true;
    }
    for (const auto& path : folder_entries(folder)) {
        const std::string name = path.filename().string();
        if (name != FolderLock::kFileName && !is_temporary_name(name))
            throw InputError(
                fmt::format("{} is not empty and not a take ('{}' is in it); choose another folder "
                            "with -o",
                            folder.string(), name));
    }
    return false;
}

std::string text_of(const nlohmann::json& parameters, const std::string& key) {
    return parameters.contains(key) ? parameters[key].dump() : "not set";
}

[[noreturn]] void cannot_resume(const fs::path& folder, const std::string& key, const std::string& in_take,
                                const std::string& in_recipe) {
    throw InputError(
        fmt::format("cannot go on with {}: {} is {} in the take and {} in the recipe; use the take's "
                    "recipe ({}), or begin anew with --force or in another folder",
                    folder.string(), key, in_take, in_recipe, recipe_path(folder).string()));
}

void check_same_run(const fs::path& folder, const TakeInfo& in_take, const TakeInfo& in_recipe) {
    if (in_take.process != in_recipe.process)
        cannot_resume(folder, "process", in_take.process, in_recipe.process);
    std::set<std::string> keys;
    for (const auto& [key, value] : in_take.parameters.items()) keys.insert(key);
    for (const auto& [key, value] : in_recipe.parameters.items()) keys.insert(key);
    for (const auto& key : keys) {
        const std::string before = text_of(in_take.parameters, key), now = text_of(in_recipe.parameters, key);
        if (before != now) cannot_resume(folder, key, before, now);
    }
    if (in_take.seed != in_recipe.seed)
        cannot_resume(folder, "seed", std::to_string(in_take.seed), std::to_string(in_recipe.seed));
}

}  // namespace

TakeWriter::TakeWriter(const fs::path& folder, TakeHeader header, std::unique_ptr<FolderLock> lock)
    : m_folder(folder), m_header(std::move(header)), m_lock(std::move(lock)) {
    remove_temporaries(m_folder);
}

TakeWriter TakeWriter::create(const fs::path& folder, const TakeInfo& info, bool replace_existing) {
    check_place(folder, replace_existing);
    make_writable_folder(folder);
    auto lock = std::make_unique<FolderLock>(folder);
    // Once more: another program may have begun and ended a take here before the lock was ours.
    if (check_place(folder, replace_existing)) remove_run(folder);
    TakeWriter writer(folder, {info, TakeStatus::Running, "", {}}, std::move(lock));
    // take.json comes first, for it makes the folder a take that --resume and --force accept.
    write_header(folder, writer.m_header, kRunAgain);
    write_whole_file(recipe_path(folder), info.recipe_text, kResume);
    make_writable_folder(folder / "meshes");
    make_writable_folder(folder / "frames");
    return writer;
}

TakeWriter TakeWriter::resume(const fs::path& folder, const TakeInfo& info) {
    read_header(folder);
    auto lock = std::make_unique<FolderLock>(folder);
    TakeHeader header = read_header(folder);
    check_same_run(folder, header.info, info);
    const std::string version_before = header.info.program_version;
    header.info = info;
    header.status = TakeStatus::Running;
    header.reason.clear();

    TakeWriter writer(folder, std::move(header), std::move(lock));
    if (!has_checkpoint(folder)) {
        remove_run(folder);
        writer.m_header.mesh_names.clear();
    }
    for (const auto& name : writer.m_header.mesh_names) {
        const fs::path path = mesh_path(folder, name);
        writer.m_vertex_counts[name] = mesh_from(read_array_file(path), path.string()).rest.positions.size();
    }
    write_header(folder, writer.m_header, kResume);
    write_whole_file(recipe_path(folder), info.recipe_text, kResume);
    make_writable_folder(folder / "meshes");
    make_writable_folder(folder / "frames");
    if (version_before != info.program_version)
        writer.log(fmt::format("begun by version {}, resumed by version {}: not sure to give the same bits",
                               version_before, info.program_version));
    return writer;
}

void TakeWriter::add_mesh(const TakeMesh& mesh) {
    if (!is_mesh_name(mesh.name)) throw std::logic_error("'" + mesh.name + "' cannot be the name of a mesh");
    write_whole_file(mesh_path(m_folder, mesh.name), encode_array_file(to_array_file(mesh)), kResume);
    m_vertex_counts[mesh.name] = mesh.rest.positions.size();
    auto& names = m_header.mesh_names;
    if (std::find(names.begin(), names.end(), mesh.name) == names.end()) {
        names.push_back(mesh.name);
        write_header(m_folder, m_header, kResume);
    }
}

void TakeWriter::add_frame(const Frame& frame) {
    if (frame.index < 0) throw std::logic_error("a frame with a negative index");
    for (const auto& mesh : frame.meshes) {
        const auto found = m_vertex_counts.find(mesh.name);
        if (found == m_vertex_counts.end() || found->second != mesh.positions.size())
            throw std::logic_error("mesh '" + mesh.name + "' of a frame does not fit the take's mesh");
    }
    std::vector<WholeFile> files = map_files(m_folder, frame);
    // The frame comes last, for what it names must be there: a frame without its maps does not count.
    files.push_back({frame_path(m_folder, frame.index), encode_array_file(to_array_file(frame))});
    write_whole_files(files, kResume);
}

void TakeWriter::save_checkpoint(std::span<const std::byte> bytes) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(bytes.data());
    ArrayFile file;
    file.meta = {{"kind", "checkpoint"}};
    file.arrays.push_back(
        {"checkpoint", {bytes.size()}, std::vector<std::uint8_t>(first, first + bytes.size())});
    write_whole_file(checkpoint_path(m_folder), encode_array_file(file), kResume);
}

void TakeWriter::set_summary(const nlohmann::json& summary) {
    write_whole_file(summary_path(m_folder),
                     summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n", kResume);
}

void TakeWriter::set_status(TakeStatus status, const std::string& reason) {
    m_header.status = status;
    m_header.reason = reason;
    write_header(m_folder, m_header, kResume);
}

void TakeWriter::log(const std::string& line) noexcept {
    const int descriptor =
        ::open((m_folder / "log.txt").c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) return;
    const std::string text = line + "\n";
    write_all(descriptor, std::as_bytes(std::span(text)));
    ::close(descriptor);
}

std::optional<std::vector<std::byte>> TakeWriter::checkpoint() const {
    if (!has_checkpoint(m_folder)) return std::nullopt;
    return read_checkpoint(m_folder);
}

}  // namespace windfall::take
