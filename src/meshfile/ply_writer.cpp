#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>

#include "meshfile/ply.h"

namespace windfall::meshfile {
namespace {

/// Puts numbers of a type behind each other; in text a line each row.
class PlyBody {
  public:
    explicit PlyBody(PlyEncoding encoding) : m_encoding(encoding) {}

    void put(PlyType type, double value) {
        if (m_encoding == PlyEncoding::Ascii) {
            fmt::format_to(std::back_inserter(m_bytes), "{}{}", m_line_begins ? "" : " ", value);
            m_line_begins = false;
            return;
        }
        switch (type) {
            case PlyType::Int8:
                return raw<std::int8_t>(value);
            case PlyType::UInt8:
                return raw<std::uint8_t>(value);
            case PlyType::Int16:
                return raw<std::int16_t>(value);
            case PlyType::UInt16:
                return raw<std::uint16_t>(value);
            case PlyType::Int32:
                return raw<std::int32_t>(value);
            case PlyType::UInt32:
                return raw<std::uint32_t>(value);
            case PlyType::Float32:
                return raw<float>(value);
            case PlyType::Float64:
                return raw<double>(value);
        }
    }
    void end_row() {
        if (m_encoding == PlyEncoding::Ascii) m_bytes.push_back('\n');
        m_line_begins = true;
    }
    const fmt::memory_buffer& bytes() const { return m_bytes; }

  private:
    template <class T>
    void raw(double value) {
        T number{};
        if constexpr (std::numeric_limits<T>::is_integer)
            number = static_cast<T>(std::clamp(std::round(value),
                                               static_cast<double>(std::numeric_limits<T>::min()),
                                               static_cast<double>(std::numeric_limits<T>::max())));
        else
            number = static_cast<T>(value);
        auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(number);
        if (m_encoding == PlyEncoding::BigEndian) std::reverse(bytes.begin(), bytes.end());
        m_bytes.append(bytes.data(), bytes.data() + bytes.size());
    }

    PlyEncoding m_encoding;
    fmt::memory_buffer m_bytes;
    bool m_line_begins = true;
};

std::vector<std::string> words(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

/// The type that the file has for a property; float where it has none.
PlyType type_of(const PlyElement* element, const std::string& property) {
    const PlyProperty* found = element != nullptr ? element->find(property) : nullptr;
    return found != nullptr ? found->type : PlyType::Float32;
}

/// Integers cannot hold what is interpolated between them, except colours.
double fitting(PlyType type, double value) {
    if (value != value) return 0;
    return type == PlyType::Float32 || type == PlyType::Float64 ? value : std::round(value);
}

class PlyWriter {
  public:
    explicit PlyWriter(const NamedMesh& named)
        : m_mesh(*named.mesh),
          m_shift(named.shift),
          m_source(dynamic_cast<const PlySource*>(named.mesh->source.get())),
          m_encoding(m_source != nullptr ? m_source->encoding : PlyEncoding::LittleEndian),
          m_vertex(m_source != nullptr ? m_source->find("vertex") : nullptr),
          m_face(m_source != nullptr ? m_source->find("face") : nullptr),
          m_body(m_encoding) {
        for (const Attribute& attribute : m_mesh.attributes)
            if (attribute.on_corners && attribute.role == Role::TextureCoordinate) m_texture = &attribute;
    }

    std::vector<std::byte> bytes() {
        put_vertices();
        put_faces();
        const std::string head = header();
        std::vector<std::byte> result;
        for (const auto part : {std::as_bytes(std::span(head)),
                                std::as_bytes(std::span(m_body.bytes().data(), m_body.bytes().size()))})
            result.insert(result.end(), part.begin(), part.end());
        return result;
    }

  private:
    std::string header() const {
        static constexpr std::array<const char*, 3> kNames{"ascii", "binary_little_endian",
                                                           "binary_big_endian"};
        std::string text = fmt::format("ply\nformat {} 1.0\n", kNames[static_cast<std::size_t>(m_encoding)]);
        if (m_source != nullptr)
            for (const std::string& comment : m_source->comments) text += comment + "\n";
        for (std::size_t m = 0; m < m_mesh.materials.size(); ++m)
            text += fmt::format("comment part {} {}\n", m + 1, m_mesh.materials[m].name);
        const auto scalar = [&](const PlyElement* element, const std::string& name) {
            text += fmt::format("property {} {}\n", ply_type_name(type_of(element, name)), name);
        };
        text += fmt::format("element vertex {}\n", m_mesh.positions.size());
        for (const char* axis : {"x", "y", "z"}) scalar(m_vertex, axis);
        for (const Attribute& attribute : m_mesh.attributes)
            for (const std::string& name : words(attribute.name))
                if (!attribute.on_corners) scalar(m_vertex, name);
        text += fmt::format("element face {}\nproperty list {} int vertex_indices\n", m_mesh.face_count(),
                            ply_type_name(count_type()));
        if (m_texture != nullptr)
            text += fmt::format("property list {} float texcoord\n", ply_type_name(count_type()));
        for (const FaceColumn& column : m_mesh.face_columns) scalar(m_face, column.name);
        if (!m_mesh.materials.empty()) text += "property uchar part\n";
        return text + "end_header\n";
    }

    PlyType count_type() const {
        std::size_t longest = 0;
        for (std::size_t f = 0; f < m_mesh.face_count(); ++f)
            longest = std::max(longest, m_mesh.corner_count(f));
        return longest < 127 ? PlyType::UInt8 : PlyType::Int32;
    }

    void put_vertices() {
        for (std::size_t v = 0; v < m_mesh.positions.size(); ++v) {
            const Vec3 p = m_mesh.positions[v] + m_shift;
            for (int k = 0; k < 3; ++k)
                m_body.put(type_of(m_vertex, std::string(1, static_cast<char>('x' + k))), p[k]);
            for (const Attribute& attribute : m_mesh.attributes) {
                if (attribute.on_corners) continue;
                const std::vector<std::string> names = words(attribute.name);
                for (std::size_t k = 0; k < names.size(); ++k) {
                    const PlyType type = type_of(m_vertex, names[k]);
                    m_body.put(type, fitting(type, attribute.values[v * names.size() + k]));
                }
            }
            m_body.end_row();
        }
    }

    void put_faces() {
        const PlyType count = count_type();
        for (std::size_t f = 0; f < m_mesh.face_count(); ++f) {
            m_body.put(count, static_cast<double>(m_mesh.corner_count(f)));
            for (std::size_t c = m_mesh.face_starts[f]; c < m_mesh.face_starts[f + 1]; ++c)
                m_body.put(PlyType::Int32, m_mesh.corners[c]);
            if (m_texture != nullptr) put_texture(count, f);
            for (const FaceColumn& column : m_mesh.face_columns) {
                const PlyType type = type_of(m_face, column.name);
                m_body.put(type, fitting(type, column.values[f]));
            }
            if (!m_mesh.materials.empty()) m_body.put(PlyType::UInt8, m_mesh.faces[f].material + 1);
            m_body.end_row();
        }
    }

    void put_texture(PlyType count, std::size_t f) {
        const std::size_t begin = m_mesh.face_starts[f], end = m_mesh.face_starts[f + 1];
        const bool has = m_texture->corner_entries[begin] >= 0;
        m_body.put(count, has ? 2 * static_cast<double>(end - begin) : 0);
        for (std::size_t c = begin; c < end && has; ++c)
            for (std::size_t k = 0; k < 2; ++k)
                m_body.put(PlyType::Float32,
                           m_texture->values[2 * static_cast<std::size_t>(m_texture->corner_entries[c]) + k]);
    }

    const Mesh& m_mesh;
    Vec3 m_shift;
    const PlySource* m_source;
    PlyEncoding m_encoding;
    const PlyElement* m_vertex;
    const PlyElement* m_face;
    const Attribute* m_texture = nullptr;
    PlyBody m_body;
};

}  // namespace

std::vector<OutputFile> encode_ply(std::span<const NamedMesh> meshes, const std::filesystem::path& path) {
    std::vector<std::string> names;
    for (const NamedMesh& named : meshes) names.push_back(named.name);
    const std::vector<std::filesystem::path> paths = output_paths(Format::Ply, path, names);
    std::vector<OutputFile> files;
    for (std::size_t m = 0; m < meshes.size(); ++m) files.push_back({paths[m], PlyWriter(meshes[m]).bytes()});
    return files;
}

}  // namespace windfall::meshfile
