#include "export/maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/parallel.h"
#include "take/map_file.h"
#include "take/whole_file.h"

namespace windfall::export_ {
namespace {

namespace fs = std::filesystem;

fs::path list_path(const fs::path& folder) { return folder / "maps" / "maps.json"; }

take::Frame dressed_frame(const take::TakeReader& take, const ExportOptions& options, int index) {
    take::Frame frame = take.frame(index);
    if (options.dress) options.dress(frame);
    return frame;
}

void refuse_existing_maps(const take::Frame& first, const ExportOptions& options, int last) {
    const auto refuse = [](const fs::path& path) {
        std::error_code problem;
        if (fs::exists(path, problem))
            throw InputError(
                fmt::format("{} is there already; add --force to replace it, or choose another folder "
                            "with -o",
                            path.string()));
    };
    refuse(list_path(options.output));
    for (const auto& map : first.maps)
        for (int index = first.index; index <= last; ++index)
            refuse(take::map_path(options.output, map, index));
}

const char* unit_of(const take::FrameMap& map) { return map.name == "displacement" ? "m" : "1"; }

// What a reader of the pictures must know and a PNG has no place for.
std::string list_text(const take::Frame& frame, int last, double scale) {
    nlohmann::ordered_json maps = nlohmann::ordered_json::array();
    for (const auto& map : frame.maps) {
        const double lengths = map.name == "displacement" ? scale : 1;
        std::string files = take::map_path("", map, frame.index).generic_string();
        files.replace(files.rfind('/'), std::string::npos, "/####.png");
        maps.push_back({{"name", map.name},
                        {"mesh", map.mesh},
                        {"files", files},
                        {"width", map.width},
                        {"height", map.height},
                        {"components", map.components},
                        {"colour_space", map.srgb ? "sRGB" : "linear"},
                        {"unit", unit_of(map)},
                        {"value_of_0", lengths * map.minimum},
                        {"value_of_65535", lengths * map.maximum}});
    }
    const nlohmann::ordered_json list = {
        {"first_frame", frame.index}, {"last_frame", last}, {"maps", std::move(maps)}};
    return list.dump(2) + "\n";
}

}  // namespace

std::vector<fs::path> export_maps(const take::TakeReader& take, const ExportOptions& options,
                                  const RunContext& context) {
    const int first_index = options.frame.value_or(0), last = options.frame.value_or(take.frame_count() - 1);
    const take::Frame first = dressed_frame(take, options, first_index);
    if (first.maps.empty())
        throw InputError(fmt::format("{} has no maps; only rotten fruit has them", take.folder().string()));
    if (!options.overwrite) refuse_existing_maps(first, options, last);
    take::make_writable_folder(options.output);

    std::vector<fs::path> written;
    for (int index = first_index; index <= last; ++index) {
        context.throw_if_cancelled();
        const take::Frame frame = index == first_index ? first : dressed_frame(take, options, index);
        std::vector<take::WholeFile> files(frame.maps.size());
        for (std::size_t i = 0; i < files.size(); ++i) {
            files[i].path = take::map_path(options.output, frame.maps[i], index);
            take::make_writable_folder(files[i].path.parent_path());
        }
        parallel_for_each(files.size(), [&](std::size_t i) {
            files[i].bytes = take::encode_map(frame.maps[i], take::MapEffort::Small);
        });
        take::write_whole_files(files);
        for (const auto& file : files) written.push_back(file.path);
        context.progress({"export", static_cast<double>(index - first_index + 1),
                          static_cast<double>(last - first_index + 1), -1,
                          fmt::format("maps of frame {}", index)});
    }
    take::write_whole_file(list_path(options.output), list_text(first, last, options.scale));
    written.push_back(list_path(options.output));
    return written;
}

}  // namespace windfall::export_
