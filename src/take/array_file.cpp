#include "take/array_file.h"

#include <fmt/format.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <memory>
#include <set>
#include <stdexcept>

#include "core/error.h"

namespace windfall::take {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are stored as they lie in memory");

// As in PNG: the first byte shows a transfer that strips bit 7, the line ends one that translates them.
constexpr std::array<std::uint8_t, 8> kMagic = {0x89, 'W', 'F', 'A', '\r', '\n', 0x1a, '\n'};
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kPreambleBytes = 20;  // magic, version, length and checksum of the header
constexpr std::size_t kMaxHeaderBytes = std::size_t{16} << 20;
constexpr std::uint64_t kMaxArrayBytes = std::uint64_t{8} << 30;
constexpr std::size_t kMaxDimensions = 8;
constexpr int kCompressionLevel = 1;

constexpr std::array<const char*, 4> kTypeNames = {"f32", "f64", "i32", "u8"};  // by alternative of ArrayData

std::uint32_t checksum(std::span<const std::byte> bytes) {
    return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

// First the lowest byte of every element, then the next: neighbouring numbers share their high bytes, which
// then stand side by side and compress.
template <class T>
std::vector<std::byte> split_bytes(const std::vector<T>& elements) {
    const auto bytes = std::as_bytes(std::span(elements));
    std::vector<std::byte> planes(bytes.size());
    for (std::size_t k = 0; k < sizeof(T); ++k)
        for (std::size_t i = 0; i < elements.size(); ++i)
            planes[k * elements.size() + i] = bytes[i * sizeof(T) + k];
    return planes;
}

template <class T>
std::vector<T> join_bytes(std::span<const std::byte> planes) {
    std::vector<T> elements(planes.size() / sizeof(T));
    const auto bytes = std::as_writable_bytes(std::span(elements));
    for (std::size_t k = 0; k < sizeof(T); ++k)
        for (std::size_t i = 0; i < elements.size(); ++i)
            bytes[i * sizeof(T) + k] = planes[k * elements.size() + i];
    return elements;
}

std::vector<std::byte> compressed(const ArrayData& data) {
    const auto planes = std::visit([](const auto& values) { return split_bytes(values); }, data);
    std::vector<std::byte> stored(ZSTD_compressBound(planes.size()));
    const std::size_t size =
        ZSTD_compress(stored.data(), stored.size(), planes.data(), planes.size(), kCompressionLevel);
    if (ZSTD_isError(size) != 0) throw RunError(fmt::format("zstd: {}", ZSTD_getErrorName(size)));
    stored.resize(size);
    return stored;
}

void append(std::vector<std::byte>& bytes, std::span<const std::byte> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
}

void append_u32(std::vector<std::byte>& bytes, std::uint32_t value) {
    append(bytes, std::as_bytes(std::span(&value, 1)));
}

std::uint32_t u32_at(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

[[noreturn]] void damaged_array(const std::string& file_name, const std::string& what) {
    throw InputError(
        fmt::format("{}: {}; put a sound copy in its place or make the take again", file_name, what));
}

// Decompresses in steps that grow with what really comes out, so that a false length costs no memory.
std::vector<std::byte> decompressed(std::span<const std::byte> stored, std::uint64_t size,
                                    const std::string& array, const std::string& file_name) {
    const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), &ZSTD_freeDCtx);
    std::vector<std::byte> bytes(std::min<std::uint64_t>(size, std::uint64_t{1} << 20));
    ZSTD_inBuffer in{stored.data(), stored.size(), 0};
    ZSTD_outBuffer out{bytes.data(), bytes.size(), 0};
    for (;;) {
        const std::size_t in_before = in.pos, out_before = out.pos;
        const std::size_t left = ZSTD_decompressStream(context.get(), &out, &in);
        if (ZSTD_isError(left) != 0)
            damaged_array(file_name,
                          fmt::format("array '{}' does not decompress ({})", array, ZSTD_getErrorName(left)));
        if (left == 0) break;
        if (out.pos == out.size && bytes.size() < size) {
            bytes.resize(std::min<std::uint64_t>(size, 2 * bytes.size()));
            out.dst = bytes.data();
            out.size = bytes.size();
        } else if (in.pos == in_before && out.pos == out_before) {
            break;
        }
    }
    if (in.pos != in.size || out.pos != size || bytes.size() != size)
        damaged_array(file_name, fmt::format("array '{}' does not have the length of its shape", array));
    return bytes;
}

// An entry of the header's list of arrays, checked.
struct Entry {
    std::string name;
    std::size_t type = 0;  // alternative of ArrayData
    std::vector<std::uint64_t> shape;
    std::uint64_t bytes = 0, offset = 0, stored_bytes = 0;
    std::uint32_t checksum = 0;
};

std::uint64_t natural_number(const nlohmann::json& object, const char* key, const std::string& file_name) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_number_unsigned())
        damaged_array(file_name, fmt::format("'{}' of an array in the header is not a natural number", key));
    return found->get<std::uint64_t>();
}

Entry checked_entry(const nlohmann::json& json, const std::string& file_name) {
    constexpr std::array<std::uint64_t, 4> kTypeBytes = {4, 8, 4, 1};
    if (!json.is_object()) damaged_array(file_name, "the list of arrays in the header is damaged");
    Entry entry;
    const auto name = json.find("name"), type = json.find("dtype"), shape = json.find("shape");
    if (name == json.end() || !name->is_string())
        damaged_array(file_name, "an array in the header has no name");
    entry.name = name->get<std::string>();
    if (type != json.end())
        entry.type = std::find(kTypeNames.begin(), kTypeNames.end(), *type) - kTypeNames.begin();
    if (type == json.end() || entry.type == kTypeNames.size())
        damaged_array(file_name, fmt::format("array '{}' is of no known type", entry.name));
    entry.bytes = kTypeBytes[entry.type];
    if (shape == json.end() || !shape->is_array() || shape->size() > kMaxDimensions)
        damaged_array(file_name, fmt::format("array '{}' has no sound shape", entry.name));
    for (const auto& length : *shape) {
        if (!length.is_number_unsigned())
            damaged_array(file_name, fmt::format("array '{}' has no sound shape", entry.name));
        entry.shape.push_back(length.get<std::uint64_t>());
        if (__builtin_mul_overflow(entry.bytes, entry.shape.back(), &entry.bytes) ||
            entry.bytes > kMaxArrayBytes)
            damaged_array(file_name,
                          fmt::format("array '{}' claims to be larger than any of a take", entry.name));
    }
    entry.offset = natural_number(json, "offset", file_name);
    entry.stored_bytes = natural_number(json, "stored_bytes", file_name);
    entry.checksum = static_cast<std::uint32_t>(natural_number(json, "crc32", file_name));
    return entry;
}

// The JSON header, after the checks that need no JSON.
nlohmann::json checked_header(std::span<const std::byte> bytes, const std::string& file_name) {
    if (bytes.size() < kPreambleBytes) damaged_array(file_name, "the file is cut off");
    if (std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0)
        damaged_array(file_name, "this is not a Windfall array file");
    if (const auto version = u32_at(bytes, 8); version != kVersion)
        damaged_array(file_name,
                      fmt::format("the file has version {} of the format, this program reads version {}",
                                  version, kVersion));
    const std::size_t header_bytes = u32_at(bytes, 12);
    if (header_bytes > kMaxHeaderBytes || header_bytes > bytes.size() - kPreambleBytes)
        damaged_array(file_name, "the file is cut off in its header");
    const auto header = bytes.subspan(kPreambleBytes, header_bytes);
    if (checksum(header) != u32_at(bytes, 16))
        damaged_array(file_name, "the header does not fit its checksum");
    const char* text = reinterpret_cast<const char*>(header.data());
    auto json = nlohmann::json::parse(text, text + header.size(), nullptr, false);
    if (!json.is_object() || !json.contains("meta") || !json["meta"].is_object() ||
        !json.contains("arrays") || !json["arrays"].is_array())
        damaged_array(file_name, "the header is damaged");
    return json;
}

ArrayData decoded(const Entry& entry, std::span<const std::byte> stored, const std::string& file_name) {
    if (checksum(stored) != entry.checksum)
        damaged_array(file_name, fmt::format("array '{}' does not fit its checksum", entry.name));
    const auto planes = decompressed(stored, entry.bytes, entry.name, file_name);
    switch (entry.type) {
        case 0:
            return join_bytes<float>(planes);
        case 1:
            return join_bytes<double>(planes);
        case 2:
            return join_bytes<std::int32_t>(planes);
        default:
            return join_bytes<std::uint8_t>(planes);
    }
}

}  // namespace

const NamedArray* ArrayFile::find(const std::string& name) const {
    for (const auto& array : arrays)
        if (array.name == name) return &array;
    return nullptr;
}

std::vector<std::byte> encode_array_file(const ArrayFile& file) {
    nlohmann::json list = nlohmann::json::array();
    std::vector<std::byte> blobs;
    std::set<std::string> names;
    for (const auto& array : file.arrays) {
        std::uint64_t count = 1;
        for (const auto length : array.shape) count *= length;
        if (count != std::visit([](const auto& values) { return values.size(); }, array.data))
            throw std::logic_error("the shape of array '" + array.name + "' does not fit its data");
        if (!names.insert(array.name).second)
            throw std::logic_error("two arrays with the name '" + array.name + "'");
        const auto stored = compressed(array.data);
        list.push_back({{"name", array.name},
                        {"dtype", kTypeNames[array.data.index()]},
                        {"shape", array.shape},
                        {"offset", blobs.size()},
                        {"stored_bytes", stored.size()},
                        {"crc32", checksum(stored)}});
        append(blobs, stored);
    }
    const std::string header = nlohmann::json{{"meta", file.meta}, {"arrays", list}}.dump(
        -1, ' ', false, nlohmann::json::error_handler_t::replace);
    if (header.size() > kMaxHeaderBytes) throw std::logic_error("the header of an array file is too long");

    std::vector<std::byte> bytes;
    bytes.reserve(kPreambleBytes + header.size() + blobs.size());
    append(bytes, std::as_bytes(std::span(kMagic)));
    append_u32(bytes, kVersion);
    append_u32(bytes, static_cast<std::uint32_t>(header.size()));
    append_u32(bytes, checksum(bytes_of(header)));
    append(bytes, bytes_of(header));
    append(bytes, blobs);
    return bytes;
}

ArrayFile decode_array_file(std::span<const std::byte> bytes, const std::string& file_name) {
    nlohmann::json header = checked_header(bytes, file_name);
    auto rest = bytes.subspan(kPreambleBytes + u32_at(bytes, 12));
    ArrayFile file;
    file.meta = std::move(header["meta"]);
    std::set<std::string> names;
    std::uint64_t offset = 0;
    for (const auto& json : header["arrays"]) {
        Entry entry = checked_entry(json, file_name);
        if (!names.insert(entry.name).second)
            damaged_array(file_name, fmt::format("two arrays have the name '{}'", entry.name));
        if (entry.offset != offset)
            damaged_array(file_name, fmt::format("array '{}' does not follow the one before it", entry.name));
        if (entry.stored_bytes > rest.size())
            damaged_array(file_name, fmt::format("the file is cut off in array '{}'", entry.name));
        auto data = decoded(entry, rest.first(entry.stored_bytes), file_name);
        rest = rest.subspan(entry.stored_bytes);
        offset += entry.stored_bytes;
        file.arrays.push_back({std::move(entry.name), std::move(entry.shape), std::move(data)});
    }
    if (!rest.empty()) damaged_array(file_name, "there are more bytes than arrays");
    return file;
}

template <class T>
const std::vector<T>& required_array(const ArrayFile& file, const std::string& name,
                                     const std::vector<std::uint64_t>& shape, const std::string& file_name) {
    const NamedArray* array = file.find(name);
    if (array == nullptr) damaged_array(file_name, fmt::format("array '{}' is missing", name));
    const auto fits = [](std::uint64_t wanted, std::uint64_t length) {
        return wanted == 0 || wanted == length;
    };
    if (!std::equal(shape.begin(), shape.end(), array->shape.begin(), array->shape.end(), fits))
        damaged_array(file_name, fmt::format("array '{}' has the shape ({}), not ({})", name,
                                             fmt::join(array->shape, ", "), fmt::join(shape, ", ")));
    const auto* values = std::get_if<std::vector<T>>(&array->data);
    if (values == nullptr)
        damaged_array(file_name,
                      fmt::format("array '{}' is of type {}", name, kTypeNames[array->data.index()]));
    return *values;
}

template const std::vector<float>& required_array(const ArrayFile&, const std::string&,
                                                  const std::vector<std::uint64_t>&, const std::string&);
template const std::vector<double>& required_array(const ArrayFile&, const std::string&,
                                                   const std::vector<std::uint64_t>&, const std::string&);
template const std::vector<std::int32_t>& required_array(const ArrayFile&, const std::string&,
                                                         const std::vector<std::uint64_t>&,
                                                         const std::string&);
template const std::vector<std::uint8_t>& required_array(const ArrayFile&, const std::string&,
                                                         const std::vector<std::uint64_t>&,
                                                         const std::string&);

}  // namespace windfall::take
