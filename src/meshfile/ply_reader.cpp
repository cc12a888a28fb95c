// A reader of our own: of what Debian has, Assimp splits and reorders vertices and OpenMesh drops the texture
// coordinates of corners.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/error.h"
#include "meshfile/ply.h"
#include "meshfile/text_scanner.h"

namespace windfall::meshfile {
namespace {

/// The numbers of the body, one after another.
class PlyNumbers {
  public:
    PlyNumbers(std::string_view body, PlyEncoding encoding, const std::string& name, std::size_t header_lines)
        : m_body(body),
          m_encoding(encoding),
          m_name(name),
          m_header_lines(header_lines),
          m_scan(body, name) {}

    double next(PlyType type) {
        if (m_encoding == PlyEncoding::Ascii) return next_word();
        switch (type) {
            case PlyType::Int8:
                return raw<std::int8_t>();
            case PlyType::UInt8:
                return raw<std::uint8_t>();
            case PlyType::Int16:
                return raw<std::int16_t>();
            case PlyType::UInt16:
                return raw<std::uint16_t>();
            case PlyType::Int32:
                return raw<std::int32_t>();
            case PlyType::UInt32:
                return raw<std::uint32_t>();
            case PlyType::Float32:
                return raw<float>();
            case PlyType::Float64:
                break;
        }
        return raw<double>();
    }

    [[noreturn]] void fail(const std::string& what) const {
        if (m_encoding == PlyEncoding::Ascii)
            throw InputError(fmt::format("{}:{}: {}; export the mesh again", m_name,
                                         m_header_lines + m_scan.line_number(), what));
        throw InputError(
            fmt::format("{}: {}, at byte {} of the data; export the mesh again", m_name, what, m_at));
    }

  private:
    double next_word() {
        std::string_view word = m_scan.word();
        while (word.empty()) {
            if (!m_scan.next_line()) fail("the file ends too early");
            word = m_scan.word();
        }
        double value = 0;
        const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (problem != std::errc{} || end != word.data() + word.size())
            fail(fmt::format("\"{}\" is not a number", word));
        return value;
    }

    template <class T>
    double raw() {
        std::array<char, sizeof(T)> bytes{};
        if (m_body.size() - m_at < sizeof(T)) fail("the file ends too early");
        std::memcpy(bytes.data(), m_body.data() + m_at, sizeof(T));
        m_at += sizeof(T);
        if (m_encoding == PlyEncoding::BigEndian) std::reverse(bytes.begin(), bytes.end());
        return static_cast<double>(std::bit_cast<T>(bytes));
    }

    std::string_view m_body;
    PlyEncoding m_encoding;
    std::string m_name;
    std::size_t m_header_lines;
    TextScanner m_scan;
    std::size_t m_at = 0;
};

/// Properties that belong together when they follow each other.
struct Family {
    std::vector<const char*> names;
    Role role;
};

const std::vector<Family>& families() {
    static const std::vector<Family> all{{{"nx", "ny", "nz"}, Role::Normal},
                                         {{"s", "t"}, Role::TextureCoordinate},
                                         {{"u", "v"}, Role::TextureCoordinate},
                                         {{"texture_u", "texture_v"}, Role::TextureCoordinate},
                                         {{"red", "green", "blue", "alpha"}, Role::Colour},
                                         {{"red", "green", "blue"}, Role::Colour}};
    return all;
}

/// Attributes for the properties of vertices but x, y, z; their names are those of the properties, separated
/// by blanks.
std::vector<Attribute> vertex_attributes(const PlyElement& element) {
    std::vector<Attribute> result;
    const auto& properties = element.properties;
    for (std::size_t i = 0; i < properties.size();) {
        const std::string& name = properties[i].name;
        if (properties[i].is_list || name == "x" || name == "y" || name == "z") {
            ++i;
            continue;
        }
        Attribute attribute{name, Role::Other, 1, {}, false, {}};
        for (const Family& family : families()) {
            bool matches = i + family.names.size() <= properties.size();
            for (std::size_t k = 0; k < family.names.size() && matches; ++k)
                matches = !properties[i + k].is_list && properties[i + k].name == family.names[k];
            if (!matches) continue;
            attribute.role = family.role;
            attribute.components = static_cast<int>(family.names.size());
            for (std::size_t k = 1; k < family.names.size(); ++k)
                attribute.name += " " + properties[i + k].name;
            break;
        }
        i += static_cast<std::size_t>(attribute.components);
        result.push_back(std::move(attribute));
    }
    return result;
}

void read_vertices(const PlyElement& element, PlyNumbers& numbers, Mesh& mesh) {
    for (const char* axis : {"x", "y", "z"})
        if (element.find(axis) == nullptr || element.find(axis)->is_list)
            numbers.fail(fmt::format("vertices have no property {}", axis));
    mesh.attributes = vertex_attributes(element);
    // Where the value of each property goes: to an axis, or to the end of an attribute.
    std::vector<Attribute*> target;
    std::size_t next = 0;
    int component = 0;
    for (const PlyProperty& p : element.properties) {
        const bool is_axis = p.name == "x" || p.name == "y" || p.name == "z";
        target.push_back(is_axis || p.is_list ? nullptr : &mesh.attributes[next]);
        if (target.back() != nullptr && ++component == mesh.attributes[next].components)
            ++next, component = 0;
    }
    for (std::size_t v = 0; v < element.count; ++v) {
        Vec3 position = Vec3::Zero();
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& p = element.properties[i];
            if (p.is_list) {
                for (double left = numbers.next(p.count_type); left > 0; --left) numbers.next(p.type);
                continue;
            }
            const double value = numbers.next(p.type);
            if (target[i] != nullptr)
                target[i]->values.push_back(value);
            else
                position[p.name[0] - 'x'] = value;
        }
        mesh.positions.push_back(position);
    }
}

bool is_corner_list(const PlyProperty& p) {
    return p.is_list && (p.name == "vertex_indices" || p.name == "vertex_index");
}
bool is_texture_list(const PlyProperty& p) { return p.is_list && p.name == "texcoord"; }

class FaceReader {
  public:
    FaceReader(const PlyElement& element, PlyNumbers& numbers, Mesh& mesh)
        : m_element(element), m_numbers(numbers), m_mesh(mesh) {
        bool has_corners = false;
        for (const PlyProperty& p : element.properties) {
            has_corners = has_corners || is_corner_list(p);
            if (!p.is_list) mesh.face_columns.push_back({p.name, {}});
            if (is_texture_list(p)) m_texture = Attribute{p.name, Role::TextureCoordinate, 2, {}, true, {}};
        }
        if (!has_corners) numbers.fail("faces have no list vertex_indices");
    }

    void read() {
        for (std::size_t f = 0; f < m_element.count; ++f) read_face();
        if (m_texture.on_corners) m_mesh.attributes.push_back(std::move(m_texture));
    }

  private:
    void read_face() {
        std::size_t column = 0;
        std::vector<double> uvs;
        const std::size_t start = m_mesh.corners.size();
        for (const PlyProperty& p : m_element.properties) {
            if (!p.is_list) {
                m_mesh.face_columns[column++].values.push_back(m_numbers.next(p.type));
                continue;
            }
            const double count = m_numbers.next(p.count_type);
            if (!(count >= 0 && count <= kMaxCorners)) m_numbers.fail("a list is too long");
            for (double k = 0; k < count; ++k) {
                const double value = m_numbers.next(p.type);
                if (is_corner_list(p)) add_corner(value);
                if (is_texture_list(p)) uvs.push_back(value);
            }
        }
        const std::size_t corners = m_mesh.corners.size() - start;
        if (corners < 3) m_numbers.fail("a face has fewer than three corners");
        if (m_mesh.corners.size() > kMaxCorners) m_numbers.fail("the mesh is too large; decimate it");
        m_mesh.face_starts.push_back(m_mesh.corners.size());
        m_mesh.faces.push_back({0, -1, 0});
        if (m_texture.on_corners) add_texture(uvs, corners);
    }

    void add_corner(double value) {
        if (!(value >= 0 && value < static_cast<double>(m_mesh.positions.size())))
            m_numbers.fail(
                fmt::format("a face points to vertex {}, but there are {}", value, m_mesh.positions.size()));
        m_mesh.corners.push_back(static_cast<std::int32_t>(value));
    }

    /// An empty list means none.
    void add_texture(const std::vector<double>& uvs, std::size_t corners) {
        if (!uvs.empty() && uvs.size() != 2 * corners) m_numbers.fail("a list texcoord has the wrong length");
        for (std::size_t k = 0; k < corners; ++k)
            m_texture.corner_entries.push_back(
                uvs.empty() ? -1 : static_cast<std::int32_t>(m_texture.values.size() / 2 + k));
        m_texture.values.insert(m_texture.values.end(), uvs.begin(), uvs.end());
    }

    const PlyElement& m_element;
    PlyNumbers& m_numbers;
    Mesh& m_mesh;
    Attribute m_texture;
};

void skip(const PlyElement& element, PlyNumbers& numbers, Mesh& mesh) {
    for (std::size_t i = 0; i < element.count; ++i)
        for (const PlyProperty& p : element.properties)
            for (double left = p.is_list ? numbers.next(p.count_type) : 1; left > 0; --left)
                numbers.next(p.type);
    mesh.warnings.push_back(fmt::format("the elements \"{}\" are left out", element.name));
}

void warn_of_lists(const PlyElement& element, Mesh& mesh) {
    for (const PlyProperty& p : element.properties)
        if (p.is_list && !is_corner_list(p) && !(element.name == "face" && is_texture_list(p)))
            mesh.warnings.push_back(fmt::format("the lists \"{}\" of {} are left out", p.name, element.name));
}

}  // namespace

Mesh read_ply(std::string_view text, const std::string& name) {
    std::size_t body = 0, header_lines = 0;
    const auto source = read_ply_header(text, name, body, header_lines);
    Mesh mesh;
    mesh.groups.push_back({});
    mesh.source = source;
    PlyNumbers numbers(text.substr(body), source->encoding, name, header_lines);
    for (const PlyElement& element : source->elements) {
        // Every element takes a byte at least: no memory is asked for on the word of a header alone.
        if (element.count > text.size())
            numbers.fail(fmt::format("there cannot be {} of \"{}\"", element.count, element.name));
        if ((element.name == "vertex" || element.name == "face") && &element != source->find(element.name))
            numbers.fail(fmt::format("there is a second element \"{}\"", element.name));
        if (element.name == "vertex") {
            read_vertices(element, numbers, mesh);
        } else if (element.name == "face") {
            FaceReader(element, numbers, mesh).read();
        } else if (element.name == "tristrips") {
            numbers.fail("triangle strips are not read; export it as triangles");
        } else {
            skip(element, numbers, mesh);
            continue;
        }
        warn_of_lists(element, mesh);
    }
    return mesh;
}

}  // namespace windfall::meshfile
