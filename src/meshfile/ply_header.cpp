#include <array>
#include <stdexcept>

#include "meshfile/ply.h"
#include "meshfile/text_scanner.h"

namespace windfall::meshfile {
namespace {

struct TypeNames {
    PlyType type;
    const char* name;
    const char* other_name;
    std::size_t bytes;
};

constexpr std::array<TypeNames, 8> kTypes{{{PlyType::Int8, "char", "int8", 1},
                                           {PlyType::UInt8, "uchar", "uint8", 1},
                                           {PlyType::Int16, "short", "int16", 2},
                                           {PlyType::UInt16, "ushort", "uint16", 2},
                                           {PlyType::Int32, "int", "int32", 4},
                                           {PlyType::UInt32, "uint", "uint32", 4},
                                           {PlyType::Float32, "float", "float32", 4},
                                           {PlyType::Float64, "double", "float64", 8}}};

PlyType type_word(TextScanner& scan) {
    const std::string_view word = scan.word();
    try {
        return ply_type(word);
    } catch (const std::out_of_range&) {
        scan.fail(fmt::format("PLY has no type \"{}\"", word));
    }
}

PlyEncoding encoding_word(TextScanner& scan) {
    const std::string_view word = scan.word();
    if (word == "ascii") return PlyEncoding::Ascii;
    if (word == "binary_little_endian") return PlyEncoding::LittleEndian;
    if (word == "binary_big_endian") return PlyEncoding::BigEndian;
    scan.fail(fmt::format("PLY has no format \"{}\"", word));
}

PlyProperty property(TextScanner& scan) {
    PlyProperty result;
    const TextScanner before = scan;
    if (scan.word() == "list") {
        result.is_list = true;
        result.count_type = type_word(scan);
    } else {
        scan = before;
    }
    result.type = type_word(scan);
    result.name = scan.word();
    if (result.name.empty()) scan.fail("a property without a name");
    return result;
}

}  // namespace

PlyType ply_type(std::string_view name) {
    for (const TypeNames& t : kTypes)
        if (name == t.name || name == t.other_name) return t.type;
    throw std::out_of_range("no PLY type");
}

const char* ply_type_name(PlyType type) { return kTypes[static_cast<std::size_t>(type)].name; }

std::size_t ply_type_bytes(PlyType type) { return kTypes[static_cast<std::size_t>(type)].bytes; }

std::shared_ptr<PlySource> read_ply_header(std::string_view text, const std::string& name, std::size_t& body,
                                           std::size_t& body_line) {
    auto source = std::make_shared<PlySource>();
    TextScanner scan(text, name);
    if (!scan.next_line() || scan.word() != "ply") scan.fail("this is no PLY file");
    while (true) {
        if (!scan.next_line()) scan.fail("the header does not end");
        const std::string line(scan.rest());
        const std::string_view word = scan.word();
        if (word == "end_header") break;
        if (word == "format") {
            source->encoding = encoding_word(scan);
        } else if (word == "comment" || word == "obj_info") {
            source->comments.push_back(line);
        } else if (word == "element") {
            PlyElement element;
            element.name = scan.word();
            element.count = scan.number<std::size_t>(scan.word());
            source->elements.push_back(std::move(element));
        } else if (word == "property") {
            if (source->elements.empty()) scan.fail("a property of no element");
            source->elements.back().properties.push_back(property(scan));
        } else if (!word.empty()) {
            scan.fail(fmt::format("the header cannot have \"{}\"", word));
        }
    }
    body = scan.offset();
    body_line = scan.line_number();
    return source;
}

}  // namespace windfall::meshfile
