#include "take/frame_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "core/error.h"
#include "take/frame_file_parts.h"

namespace windfall::take {
namespace {

using geometry::Face;
using geometry::Vec2;
using geometry::Vec3;

constexpr std::size_t kMostMaterials = 256;  // what a byte a face can tell apart

// Adds the attributes as arrays `prefix`NAME and returns their names.
nlohmann::json add_attributes(ArrayFile& file, const std::string& prefix,
                              const std::vector<Attribute>& attributes, std::size_t vertices) {
    nlohmann::json names = nlohmann::json::array();
    for (const auto& attribute : attributes) {
        if (attribute.components < 1 || attribute.values.size() != vertices * attribute.components)
            throw std::logic_error("attribute '" + attribute.name +
                                   "' does not fit the vertices of its mesh");
        names.push_back(attribute.name);
        file.arrays.push_back({prefix + attribute.name,
                               {vertices, static_cast<std::uint64_t>(attribute.components)},
                               attribute.values});
    }
    return names;
}

std::vector<Attribute> attributes_from(const ArrayFile& file, const nlohmann::json& names,
                                       const std::string& prefix, std::size_t vertices,
                                       const std::string& file_name) {
    std::vector<Attribute> attributes;
    for (const auto& name : names) {
        Attribute attribute;
        attribute.name = name.get<std::string>();
        attribute.values = required_array<float>(file, prefix + attribute.name, {0, 0}, file_name);
        const auto& shape = file.find(prefix + attribute.name)->shape;
        if (shape[0] != vertices || shape[1] < 1 || shape[1] > 1024)
            damaged_frame(file_name, fmt::format("attribute '{}' does not fit the vertices of its mesh",
                                                 attribute.name));
        attribute.components = static_cast<int>(shape[1]);
        attributes.push_back(std::move(attribute));
    }
    return attributes;
}

void check_kind(const ArrayFile& file, const char* kind, const std::string& file_name) {
    if (file.meta.value("kind", std::string()) != kind)
        damaged_frame(file_name, fmt::format("this is not a {}", kind));
}

Frame frame_from_checked_json(const ArrayFile& file, const std::string& file_name) {
    check_kind(file, "frame", file_name);
    Frame frame;
    frame.index = file.meta.at("index").get<int>();
    frame.time = number_or_nan(file.meta.at("time"));
    for (const auto& [name, value] : file.meta.at("scalars").items())
        frame.scalars[name] = number_or_nan(value);
    for (const auto& json : file.meta.at("meshes")) {
        FrameMesh mesh;
        mesh.name = json.at("name").get<std::string>();
        mesh.positions = vectors3<Eigen::Vector3f>(
            required_array<float>(file, mesh.name + "/positions", {0, 3}, file_name));
        mesh.attributes = attributes_from(file, json.at("attributes"), mesh.name + "/attributes/",
                                          mesh.positions.size(), file_name);
        frame.meshes.push_back(std::move(mesh));
    }
    read_map_descriptions(file, frame, file_name);
    read_curves(file, frame, file_name);
    return frame;
}

void check_faces(const geometry::SurfaceMesh& mesh, const std::string& file_name) {
    const auto vertices = static_cast<std::int64_t>(mesh.positions.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        for (int c = 0; c < 4; ++c) {
            const std::int32_t v = mesh.faces[f][c];
            const bool absent = c == 3 && v == geometry::kNoVertex;
            if (!absent && (v < 0 || v >= vertices))
                damaged_frame(file_name, fmt::format("face {} names vertex {} of {}", f, v, vertices));
        }
}

// A mesh without materials says nothing of them, as all did before there were any.
void read_materials(const ArrayFile& file, TakeMesh& mesh, const std::string& file_name) {
    const auto json = file.meta.find("materials");
    if (json == file.meta.end()) return;
    for (const auto& material : *json)
        mesh.materials.push_back({material.at("name").get<std::string>(), material.at("hard").get<bool>()});
    mesh.face_materials =
        required_array<std::uint8_t>(file, "face_materials", {mesh.rest.faces.size()}, file_name);
    if (mesh.face_materials.size() != mesh.rest.faces.size())
        damaged_frame(file_name, "the materials do not fit the faces");
    for (const auto place : mesh.face_materials)
        if (place >= mesh.materials.size())
            damaged_frame(file_name,
                          fmt::format("a face is of material {} of {}", place, mesh.materials.size()));
}

void add_materials(ArrayFile& file, const TakeMesh& mesh) {
    if (mesh.materials.empty() && mesh.face_materials.empty()) return;
    if (mesh.face_materials.size() != mesh.rest.faces.size() || mesh.materials.empty() ||
        mesh.materials.size() > kMostMaterials ||
        std::ranges::any_of(mesh.face_materials, [&](auto m) { return m >= mesh.materials.size(); }))
        throw std::logic_error("the materials of mesh '" + mesh.name + "' do not fit its faces");
    auto& json = file.meta["materials"] = nlohmann::json::array();
    for (const auto& material : mesh.materials)
        json.push_back({{"name", material.name}, {"hard", material.hard}});
    file.arrays.push_back({"face_materials", {mesh.face_materials.size()}, mesh.face_materials});
}

TakeMesh mesh_from_checked_json(const ArrayFile& file, const std::string& file_name) {
    check_kind(file, "mesh", file_name);
    TakeMesh mesh;
    mesh.name = file.meta.at("name").get<std::string>();
    mesh.rest.positions = vectors3<Vec3>(required_array<double>(file, "positions", {0, 3}, file_name));
    const auto& faces = required_array<std::int32_t>(file, "faces", {0, 4}, file_name);
    mesh.rest.faces.resize(faces.size() / 4);
    for (std::size_t f = 0; f < mesh.rest.faces.size(); ++f)
        std::copy_n(faces.begin() + static_cast<std::ptrdiff_t>(4 * f), 4, mesh.rest.faces[f].begin());
    check_faces(mesh.rest, file_name);
    if (file.find("corner_uvs") != nullptr) {
        const auto& uvs = required_array<double>(file, "corner_uvs", {0, 4, 2}, file_name);
        if (uvs.size() != 2 * faces.size())
            damaged_frame(file_name, "the texture coordinates do not fit the faces");
        mesh.rest.corner_uvs.resize(mesh.rest.faces.size());
        for (std::size_t i = 0; i < faces.size(); ++i)
            mesh.rest.corner_uvs[i / 4][i % 4] = Vec2(uvs[2 * i], uvs[2 * i + 1]);
    }
    mesh.attributes = attributes_from(file, file.meta.at("attributes"), "attributes/",
                                      mesh.rest.positions.size(), file_name);
    read_materials(file, mesh, file_name);
    return mesh;
}

}  // namespace

ArrayFile to_array_file(const Frame& frame) {
    ArrayFile file;
    file.meta = {{"kind", "frame"}, {"index", frame.index}, {"time", frame.time}};
    file.meta["scalars"] = frame.scalars.empty() ? nlohmann::json::object() : nlohmann::json(frame.scalars);
    file.meta["meshes"] = nlohmann::json::array();
    for (const auto& mesh : frame.meshes) {
        file.arrays.push_back(
            {mesh.name + "/positions", {mesh.positions.size(), 3}, flat<float>(mesh.positions)});
        auto attributes =
            add_attributes(file, mesh.name + "/attributes/", mesh.attributes, mesh.positions.size());
        file.meta["meshes"].push_back({{"name", mesh.name}, {"attributes", std::move(attributes)}});
    }
    add_maps(file, frame);
    add_curves(file, frame);
    return file;
}

ArrayFile to_array_file(const TakeMesh& mesh) {
    const auto& rest = mesh.rest;
    ArrayFile file;
    file.arrays.push_back({"positions", {rest.positions.size(), 3}, flat<double>(rest.positions)});
    std::vector<std::int32_t> faces;
    for (const Face& face : rest.faces) faces.insert(faces.end(), face.begin(), face.end());
    file.arrays.push_back({"faces", {rest.faces.size(), 4}, std::move(faces)});
    if (!rest.corner_uvs.empty()) {
        std::vector<double> uvs;
        for (const auto& corners : rest.corner_uvs)
            for (const Vec2& uv : corners) uvs.insert(uvs.end(), uv.begin(), uv.end());
        file.arrays.push_back({"corner_uvs", {rest.faces.size(), 4, 2}, std::move(uvs)});
    }
    auto attributes = add_attributes(file, "attributes/", mesh.attributes, rest.positions.size());
    file.meta = {{"kind", "mesh"}, {"name", mesh.name}, {"attributes", std::move(attributes)}};
    add_materials(file, mesh);
    return file;
}

Frame frame_from(const ArrayFile& file, const std::string& file_name) {
    try {
        return frame_from_checked_json(file, file_name);
    } catch (const nlohmann::json::exception& problem) {
        damaged_frame(file_name, fmt::format("the description of the frame is damaged ({})", problem.what()));
    }
}

TakeMesh mesh_from(const ArrayFile& file, const std::string& file_name) {
    try {
        return mesh_from_checked_json(file, file_name);
    } catch (const nlohmann::json::exception& problem) {
        damaged_frame(file_name, fmt::format("the description of the mesh is damaged ({})", problem.what()));
    }
}

}  // namespace windfall::take
