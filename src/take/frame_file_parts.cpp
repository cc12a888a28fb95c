#include "take/frame_file_parts.h"

#include <cstdint>
#include <stdexcept>

#include "take/take_folder.h"

namespace windfall::take {
namespace {

constexpr int kLargestSide = 1 << 15;               // of a map, in texels
constexpr int kFewestPoints = 2, kMostPoints = 64;  // of a strand

void check_lists(const FrameCurves& curves) {
    const std::size_t strands = curves.strand_count();
    if (curves.points_per_strand < kFewestPoints || curves.points_per_strand > kMostPoints ||
        curves.points.size() != strands * static_cast<std::size_t>(curves.points_per_strand) ||
        curves.colours.size() != strands || curves.numbers.size() != strands ||
        curves.faces.size() != strands || curves.face_places.size() != strands)
        throw std::logic_error("the lists of curves '" + curves.name + "' do not fit each other");
}

}  // namespace

void add_maps(ArrayFile& file, const Frame& frame) {
    if (frame.maps.empty()) return;
    auto& json = file.meta["maps"] = nlohmann::json::array();
    for (const auto& map : frame.maps)
        json.push_back({{"name", map.name},
                        {"mesh", map.mesh},
                        {"width", map.width},
                        {"height", map.height},
                        {"components", map.components},
                        {"minimum", map.minimum},
                        {"maximum", map.maximum},
                        {"srgb", map.srgb}});
}

void read_map_descriptions(const ArrayFile& file, Frame& frame, const std::string& file_name) {
    const auto json = file.meta.find("maps");
    if (json == file.meta.end()) return;
    for (const auto& entry : *json) {
        FrameMap map;
        map.name = entry.at("name").get<std::string>();
        map.mesh = entry.at("mesh").get<std::string>();
        map.width = entry.at("width").get<int>();
        map.height = entry.at("height").get<int>();
        map.components = entry.at("components").get<int>();
        map.minimum = number_or_nan(entry.at("minimum"));
        map.maximum = number_or_nan(entry.at("maximum"));
        map.srgb = entry.at("srgb").get<bool>();
        // Names become paths; what is not a name must not lead out of the take.
        if (!is_mesh_name(map.name) || (!map.mesh.empty() && !is_mesh_name(map.mesh)))
            damaged_frame(file_name, fmt::format("'{}/{}' cannot be the name of a map", map.mesh, map.name));
        if (map.width < 1 || map.height < 1 || map.width > kLargestSide || map.height > kLargestSide ||
            (map.components != 1 && map.components != 3 && map.components != 4))
            damaged_frame(file_name, fmt::format("map '{}' cannot have {} x {} texels with {} components",
                                                 map.name, map.width, map.height, map.components));
        frame.maps.push_back(std::move(map));
    }
}

void add_curves(ArrayFile& file, const Frame& frame) {
    if (frame.curves.empty()) return;
    auto& json = file.meta["curves"] = nlohmann::json::array();
    for (std::size_t i = 0; i < frame.curves.size(); ++i) {
        const FrameCurves& curves = frame.curves[i];
        check_lists(curves);
        json.push_back(
            {{"name", curves.name}, {"mesh", curves.mesh}, {"points_per_strand", curves.points_per_strand}});
        const std::uint64_t strands = curves.strand_count();
        const std::string prefix = fmt::format("curves/{}/", i);
        file.arrays.push_back({prefix + "points",
                               {strands, static_cast<std::uint64_t>(curves.points_per_strand), 3},
                               flat<float>(curves.points)});
        file.arrays.push_back({prefix + "radii", {strands}, curves.radii});
        file.arrays.push_back({prefix + "colours", {strands, 3}, flat<float>(curves.colours)});
        file.arrays.push_back({prefix + "numbers", {strands}, curves.numbers});
        file.arrays.push_back({prefix + "faces", {strands}, curves.faces});
        std::vector<float> places;
        for (const auto& place : curves.face_places) places.insert(places.end(), {place.x(), place.y()});
        file.arrays.push_back({prefix + "face_places", {strands, 2}, std::move(places)});
    }
}

void read_curves(const ArrayFile& file, Frame& frame, const std::string& file_name) {
    const auto json = file.meta.find("curves");
    if (json == file.meta.end()) return;
    for (std::size_t i = 0; i < json->size(); ++i) {
        const auto& entry = json->at(i);
        FrameCurves curves;
        curves.name = entry.at("name").get<std::string>();
        curves.mesh = entry.at("mesh").get<std::string>();
        curves.points_per_strand = entry.at("points_per_strand").get<int>();
        if (curves.points_per_strand < kFewestPoints || curves.points_per_strand > kMostPoints)
            damaged_frame(file_name, fmt::format("curves '{}' cannot have {} points a strand", curves.name,
                                                 curves.points_per_strand));
        const std::string prefix = fmt::format("curves/{}/", i);
        curves.radii = required_array<float>(file, prefix + "radii", {0}, file_name);
        curves.points =
            vectors3<Eigen::Vector3f>(required_array<float>(file, prefix + "points", {0, 0, 3}, file_name));
        curves.colours =
            vectors3<Eigen::Vector3f>(required_array<float>(file, prefix + "colours", {0, 3}, file_name));
        curves.numbers = required_array<std::int32_t>(file, prefix + "numbers", {0}, file_name);
        curves.faces = required_array<std::int32_t>(file, prefix + "faces", {0}, file_name);
        const auto& places = required_array<float>(file, prefix + "face_places", {0, 2}, file_name);
        for (std::size_t k = 0; k + 1 < places.size(); k += 2)
            curves.face_places.emplace_back(places[k], places[k + 1]);
        try {
            check_lists(curves);
        } catch (const std::logic_error& problem) {
            damaged_frame(file_name, problem.what());
        }
        frame.curves.push_back(std::move(curves));
    }
}

}  // namespace windfall::take
