#include "take/map_file.h"

#include <fmt/format.h>
#include <spng.h>
#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <set>
#include <stdexcept>

#include "core/error.h"
#include "core/parallel.h"
#include "take/take_folder.h"

namespace windfall::take {
namespace {

namespace fs = std::filesystem;

constexpr int kLargestMapSide = 1 << 15;

struct SpngFree {
    void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using SpngContext = std::unique_ptr<spng_ctx, SpngFree>;

std::size_t value_count(const FrameMap& map) {
    return static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height) *
           static_cast<std::size_t>(map.components);
}

bool is_possible_size(int width, int height, int components) {
    return width >= 1 && height >= 1 && width <= kLargestMapSide && height <= kLargestMapSide &&
           (components == 1 || components == 3 || components == 4);
}

std::uint8_t colour_type(int components) {
    if (components == 1) return SPNG_COLOR_TYPE_GRAYSCALE;
    return components == 3 ? SPNG_COLOR_TYPE_TRUECOLOR : SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
}

// The low byte of a 16-bit field is noise to a search for repetitions: run lengths and the bytes' frequencies
// find nearly as much in a tenth of the time.
void set_effort(spng_ctx* context, MapEffort effort) {
    if (effort == MapEffort::Small) return;
    spng_set_option(context, SPNG_IMG_COMPRESSION_LEVEL, 1);
    spng_set_option(context, SPNG_IMG_COMPRESSION_STRATEGY, Z_RLE);
    spng_set_option(context, SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_UP);
}

// Folders of maps, and the folders of the meshes in between.
std::vector<fs::path> map_folders(const fs::path& folder) {
    std::vector<fs::path> folders;
    for (const auto& entry : folder_entries(folder / "maps")) {
        folders.push_back(entry);
        for (const auto& inner : folder_entries(entry)) folders.push_back(inner);
    }
    std::erase_if(folders, [](const fs::path& path) {
        std::error_code problem;
        return !is_mesh_name(path.filename().string()) || !fs::is_directory(path, problem);
    });
    return folders;
}

bool is_map_file(const fs::path& path) {
    const std::string stem = path.stem().string();
    return path.extension() == ".png" && stem.size() >= 4 &&
           std::all_of(stem.begin(), stem.end(), [](char c) { return c >= '0' && c <= '9'; });
}

template <class Predicate>
void remove_in_maps(const fs::path& folder, const Predicate& is_ours) {
    for (const auto& place : map_folders(folder))
        for (const auto& path : folder_entries(place)) {
            if (!is_ours(path)) continue;
            std::error_code problem;
            fs::remove(path, problem);
            if (problem)
                throw RunError(fmt::format("cannot remove {}: {}; remove it by hand and {}", path.string(),
                                           problem.message(), kRunAgain));
        }
}

}  // namespace

std::vector<std::byte> encode_map(const FrameMap& map, MapEffort effort) {
    if (!is_possible_size(map.width, map.height, map.components) || map.values.size() != value_count(map))
        throw std::logic_error("the values of map '" + map.name + "' do not fit its size");
    const SpngContext context(spng_ctx_new(SPNG_CTX_ENCODER));
    const auto check = [](int error) {
        if (error != 0) throw RunError(fmt::format("cannot make a PNG: {}", spng_strerror(error)));
    };
    if (!context) throw RunError("cannot make a PNG: no memory");
    check(spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1));
    set_effort(context.get(), effort);
    spng_ihdr header{};
    header.width = static_cast<std::uint32_t>(map.width);
    header.height = static_cast<std::uint32_t>(map.height);
    header.color_type = colour_type(map.components);
    header.bit_depth = 16;
    check(spng_set_ihdr(context.get(), &header));
    if (map.srgb) check(spng_set_srgb(context.get(), 0));
    check(spng_encode_image(context.get(), map.values.data(), map.values.size() * sizeof(map.values[0]),
                            SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE));
    std::size_t size = 0;
    int error = 0;
    const std::unique_ptr<void, decltype(&std::free)> buffer(
        spng_get_png_buffer(context.get(), &size, &error), &std::free);
    check(error);
    const auto* begin = static_cast<const std::byte*>(buffer.get());
    return {begin, begin + size};
}

void decode_map(std::span<const std::byte> bytes, const std::string& file_name, FrameMap& map) {
    const auto damaged = [&](const std::string& what) {
        throw InputError(fmt::format("{}: {}; make the take again", file_name, what));
    };
    const SpngContext context(spng_ctx_new(0));
    if (!context) throw RunError("cannot read a PNG: no memory");
    const auto check = [&](int error) {
        if (error != 0) damaged(fmt::format("this is no sound PNG ({})", spng_strerror(error)));
    };
    check(spng_set_image_limits(context.get(), kLargestMapSide, kLargestMapSide));
    check(spng_set_png_buffer(context.get(), bytes.data(), bytes.size()));
    spng_ihdr header{};
    check(spng_get_ihdr(context.get(), &header));
    if (header.bit_depth != 16 || header.color_type != colour_type(map.components) ||
        header.width != static_cast<std::uint32_t>(map.width) ||
        header.height != static_cast<std::uint32_t>(map.height))
        damaged(fmt::format("this is not the map of {} x {} with {} components that its frame names",
                            map.width, map.height, map.components));
    map.values.resize(value_count(map));
    check(spng_decode_image(context.get(), map.values.data(), map.values.size() * sizeof(map.values[0]),
                            SPNG_FMT_PNG, 0));
}

fs::path map_path(const fs::path& folder, const FrameMap& map, int frame) {
    const fs::path place = map.mesh.empty() ? folder / "maps" : folder / "maps" / map.mesh;
    return place / map.name / fmt::format("{:04}.png", frame);
}

std::vector<WholeFile> map_files(const fs::path& folder, const Frame& frame) {
    std::vector<WholeFile> files(frame.maps.size());
    std::set<fs::path> paths;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const FrameMap& map = frame.maps[i];
        files[i].path = map_path(folder, map, frame.index);
        if (!is_mesh_name(map.name) || (!map.mesh.empty() && !is_mesh_name(map.mesh)) ||
            !paths.insert(files[i].path).second)
            throw std::logic_error("'" + map.mesh + "/" + map.name + "' cannot be the name of a map");
        std::error_code problem;
        const fs::path place = files[i].path.parent_path();
        if (!fs::is_directory(place, problem)) make_writable_folder(place);
    }
    parallel_for_each(files.size(), [&](std::size_t i) { files[i].bytes = encode_map(frame.maps[i]); });
    return files;
}

void read_maps(const fs::path& folder, Frame& frame) {
    constexpr std::uint64_t kMostBytes = std::uint64_t{16} << 30;
    parallel_for_each(frame.maps.size(), [&](std::size_t i) {
        const fs::path path = map_path(folder, frame.maps[i], frame.index);
        decode_map(read_whole_file(path, kMostBytes), path.string(), frame.maps[i]);
    });
}

void remove_maps(const fs::path& folder) { remove_in_maps(folder, is_map_file); }

void remove_map_temporaries(const fs::path& folder) {
    remove_in_maps(folder, [](const fs::path& path) { return is_temporary_name(path.filename().string()); });
}

}  // namespace windfall::take
