#include "take/take_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "take/frame_file.h"
#include "take/map_file.h"
#include "take/take_folder.h"
#include "take/whole_file.h"

namespace windfall::take {
namespace {

namespace fs = std::filesystem;

// The frames 0 .. n-1 there are. A gap means that files were removed by hand.
int count_frames(const fs::path& folder) {
    int count = 0;
    for (const int index : frame_indices(folder)) {
        if (index != count)
            throw InputError(
                fmt::format("{} is missing though there are later frames; put it back or make the take "
                            "again with --force",
                            frame_path(folder, count).string()));
        ++count;
    }
    return count;
}

const TakeMesh* find_mesh(const std::vector<TakeMesh>& meshes, const std::string& name) {
    for (const auto& mesh : meshes)
        if (mesh.name == name) return &mesh;
    return nullptr;
}

}  // namespace

TakeReader::TakeReader(const fs::path& folder) : m_folder(folder) {
    TakeHeader header = read_header(folder);
    m_info = std::move(header.info);
    m_status = header.status;
    m_reason = std::move(header.reason);
    for (const auto& name : header.mesh_names) {
        const fs::path path = mesh_path(folder, name);
        m_meshes.push_back(mesh_from(read_array_file(path), path.string()));
        if (m_meshes.back().name != name)
            throw InputError(fmt::format("{} holds the mesh '{}'; put the right file in its place",
                                         path.string(), m_meshes.back().name));
    }
    m_frame_count = count_frames(folder);
}

Frame TakeReader::frame(int index) const {
    Frame frame = frame_without_map_values(index);
    read_maps(m_folder, frame);
    return frame;
}

Frame TakeReader::frame_without_map_values(int index) const {
    if (index < 0 || index >= m_frame_count)
        throw InputError(m_frame_count == 0
                             ? fmt::format("{} has no frames yet", m_folder.string())
                             : fmt::format("{} has the frames 0 to {}, so there is no frame {}",
                                           m_folder.string(), m_frame_count - 1, index));
    const std::string path = frame_path(m_folder, index).string();
    Frame frame = frame_from(read_array_file(path), path);
    if (frame.index != index)
        throw InputError(
            fmt::format("{} holds frame {}; put the right file in its place", path, frame.index));
    for (const auto& mesh : frame.meshes) {
        const TakeMesh* fresh = find_mesh(m_meshes, mesh.name);
        if (fresh == nullptr || fresh->rest.positions.size() != mesh.positions.size())
            throw InputError(
                fmt::format("{}: mesh '{}' does not have the vertices of the take's mesh; make the take "
                            "again",
                            path, mesh.name));
    }
    for (const auto& curves : frame.curves) {
        const TakeMesh* fresh = find_mesh(m_meshes, curves.mesh);
        const auto faces = static_cast<std::int64_t>(fresh == nullptr ? 0 : fresh->rest.faces.size());
        if (std::any_of(curves.faces.begin(), curves.faces.end(),
                        [&](std::int32_t face) { return face < 0 || face >= faces; }))
            throw InputError(
                fmt::format("{}: the roots of curves '{}' are not on the take's mesh '{}'; make the take "
                            "again",
                            path, curves.name, curves.mesh));
    }
    return frame;
}

nlohmann::json TakeReader::summary() const {
    const fs::path path = summary_path(m_folder);
    std::error_code problem;
    if (!fs::exists(path, problem)) return nlohmann::json::object();
    auto json = nlohmann::json::parse(read_whole_text(path, kMaxTextBytes), nullptr, false);
    if (json.is_discarded())
        throw InputError(fmt::format("{} is damaged: not JSON; make the take again", path.string()));
    return json;
}

bool TakeReader::has_checkpoint() const { return take::has_checkpoint(m_folder); }

std::vector<std::byte> TakeReader::checkpoint() const { return read_checkpoint(m_folder); }

}  // namespace windfall::take
