#pragma once
// PLY, the Stanford polygon format: vertices and faces with properties of any name.
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "meshfile/mesh.h"
#include "meshfile/mesh_file.h"

namespace windfall::meshfile {

enum class PlyType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };
enum class PlyEncoding { Ascii, LittleEndian, BigEndian };

struct PlyProperty {
    std::string name;
    PlyType type;
    bool is_list = false;
    PlyType count_type = PlyType::UInt8;  ///< of a list
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;

    const PlyProperty* find(std::string_view property) const {
        for (const PlyProperty& p : properties)
            if (p.name == property) return &p;
        return nullptr;
    }
};

struct PlySource final : Source {
    PlySource() : Source(Format::Ply) {}
    PlyEncoding encoding = PlyEncoding::LittleEndian;
    std::vector<std::string> comments;  ///< with their words "comment" or "obj_info"
    std::vector<PlyElement> elements;

    const PlyElement* find(std::string_view element) const {
        for (const PlyElement& e : elements)
            if (e.name == element) return &e;
        return nullptr;
    }
};

/// "float", "float32" ...; throws std::out_of_range for others.
PlyType ply_type(std::string_view name);
const char* ply_type_name(PlyType type);
std::size_t ply_type_bytes(PlyType type);

/// Reads the header; `body` is where the data begins. `name` is for messages.
std::shared_ptr<PlySource> read_ply_header(std::string_view text, const std::string& name, std::size_t& body,
                                           std::size_t& body_line);

Mesh read_ply(std::string_view text, const std::string& name);

/// One file a mesh. Faces of new materials have them as the property "part", which comments explain.
std::vector<OutputFile> encode_ply(std::span<const NamedMesh> meshes, const std::filesystem::path& path);

}  // namespace windfall::meshfile
