// A reader of our own: tinyobjloader reads words that are no numbers as 0, drops materials whose file is
// missing, stops at 255 corners and does not tell lines.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>

#include "meshfile/obj.h"
#include "meshfile/text_scanner.h"
#include "meshfile/texture_path.h"

namespace windfall::meshfile {
namespace {

class ObjReader {
  public:
    ObjReader(std::string_view text, const std::string& name) : m_scan(text, name) {
        m_mesh.attributes = {{"vt", Role::TextureCoordinate, 2, {}, true, {}},
                             {"vn", Role::Normal, 3, {}, true, {}},
                             {"colour", Role::Colour, 3, {}, false, {}}};
    }

    Mesh take(const std::filesystem::path& folder, const TextOf& text_of) {
        while (m_scan.next_line()) statement(m_scan.word());
        auto source = std::make_shared<ObjSource>();
        source->folder = folder;
        for (const std::string& library : m_libraries) {
            if (!lies_below(library, folder)) {
                m_mesh.warnings.push_back(fmt::format(
                    "the materials' file {} is not read: it lies outside of the tree's folder; the "
                    "new file points to it",
                    library));
                source->other_libraries.push_back(library);
                continue;
            }
            const std::string text = text_of(library);
            if (text.empty())
                m_mesh.warnings.push_back(fmt::format("the materials' file {} is not there", library));
            source->material_text += text;
        }
        m_mesh.source = source;
        for (const std::string& ignored : m_ignored)
            m_mesh.warnings.push_back(fmt::format("statements \"{}\" are left out", ignored));
        std::erase_if(m_mesh.attributes, [](const Attribute& a) { return a.values.empty(); });
        return std::move(m_mesh);
    }

  private:
    void statement(std::string_view word) {
        if (word.empty() || word.front() == '#') return;
        if (word == "v") {
            position();
        } else if (word == "vt") {
            numbers(m_mesh.attributes[0], 1);
        } else if (word == "vn") {
            numbers(m_mesh.attributes[1], 3);
        } else if (word == "f") {
            face();
        } else if (word == "o" || word == "g") {
            (word == "o" ? m_object : m_group) = m_scan.rest();
            m_info.group = -1;
        } else if (word == "usemtl") {
            const auto [found, is_new] = m_material_of.try_emplace(std::string(m_scan.rest()),
                                                                   static_cast<int>(m_mesh.materials.size()));
            if (is_new) m_mesh.materials.push_back({found->first, found->second});
            m_info.material = found->second;
        } else if (word == "s") {
            const std::string_view group = m_scan.word();
            m_info.smoothing = group == "off" ? 0 : m_scan.number<std::uint32_t>(group);
        } else if (word == "mtllib") {
            m_libraries.emplace_back(m_scan.rest());
        } else {
            m_ignored.emplace(word);
        }
    }

    std::string_view next_word() {
        std::string_view word = m_scan.word();
        while (word == "\\" && m_scan.next_line()) word = m_scan.word();
        return word;
    }

    double finite(std::string_view word) const {
        const auto value = m_scan.number<double>(word);
        if (!std::isfinite(value)) m_scan.fail(fmt::format("\"{}\" is not a finite number", word));
        return value;
    }

    void position() {
        std::vector<double> row;
        for (std::string_view word = next_word(); !word.empty(); word = next_word())
            row.push_back(finite(word));
        if (row.size() < 3) m_scan.fail("a vertex needs three numbers");
        m_mesh.positions.emplace_back(row[0], row[1], row[2]);
        if (row.size() < 6) return;  // a fourth number is a weight
        Attribute& colour = m_mesh.attributes[2];
        colour.values.resize(3 * (m_mesh.positions.size() - 1), kAbsent);
        colour.values.insert(colour.values.end(), row.end() - 3, row.end());
    }

    void numbers(Attribute& attribute, std::size_t at_least) {
        std::size_t count = 0;
        for (std::string_view word = next_word(); !word.empty(); word = next_word(), ++count)
            if (count < static_cast<std::size_t>(attribute.components))
                attribute.values.push_back(finite(word));
        if (count < at_least) m_scan.fail(fmt::format("\"{}\" needs more numbers", attribute.name));
        for (; count < static_cast<std::size_t>(attribute.components); ++count) attribute.values.push_back(0);
    }

    /// From 1 on, or from the end back, as a number from 0 on.
    std::int32_t index(std::string_view text, std::size_t count, const char* what) const {
        auto i = m_scan.number<std::int64_t>(text);
        i = i < 0 ? static_cast<std::int64_t>(count) + i : i - 1;
        if (i < 0 || i >= static_cast<std::int64_t>(count))
            m_scan.fail(fmt::format("the face points to {} {}, but there are {} so far", what, text, count));
        return static_cast<std::int32_t>(i);
    }

    void face() {
        const std::size_t start = m_mesh.corners.size();
        for (std::string_view word = next_word(); !word.empty(); word = next_word()) {
            const std::size_t first = std::min(word.find('/'), word.size());
            const std::size_t second =
                std::min(word.find('/', std::min(first + 1, word.size())), word.size());
            m_mesh.corners.push_back(index(word.substr(0, first), m_mesh.positions.size(), "vertex"));
            entry(0, first < second ? word.substr(first + 1, second - first - 1) : std::string_view());
            entry(1, second < word.size() ? word.substr(second + 1) : std::string_view());
        }
        if (m_mesh.corners.size() - start < 3) m_scan.fail("a face needs three corners");
        if (m_mesh.corners.size() > kMaxCorners) m_scan.fail("the mesh is too large; decimate it");
        if (m_info.group < 0) {
            m_info.group = static_cast<std::int32_t>(m_mesh.groups.size());
            m_mesh.groups.push_back({m_object, m_group});
        }
        m_mesh.face_starts.push_back(m_mesh.corners.size());
        m_mesh.faces.push_back(m_info);
    }

    void entry(std::size_t attribute, std::string_view text) {
        Attribute& a = m_mesh.attributes[attribute];
        const std::size_t count = a.values.size() / static_cast<std::size_t>(a.components);
        a.corner_entries.push_back(text.empty() ? -1 : index(text, count, a.name.c_str()));
    }

    TextScanner m_scan;
    Mesh m_mesh;
    FaceInfo m_info{-1, -1, 0};
    std::string m_object, m_group;
    std::map<std::string, int> m_material_of;
    std::vector<std::string> m_libraries;
    std::set<std::string> m_ignored;
};

}  // namespace

Mesh read_obj(std::string_view text, const std::string& name, const std::filesystem::path& folder,
              const TextOf& text_of) {
    Mesh mesh = ObjReader(text, name).take(folder, text_of);
    for (Attribute& attribute : mesh.attributes)
        if (!attribute.on_corners)
            attribute.values.resize(mesh.positions.size() * static_cast<std::size_t>(attribute.components),
                                    kAbsent);
    return mesh;
}

}  // namespace windfall::meshfile
