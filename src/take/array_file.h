#pragma once
// The container of every binary file of a take: named arrays behind a JSON header, each compressed with zstd
// and guarded by a checksum. docs/take-format.md describes the bytes for people who write their own reader.
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace windfall::take {

/// Elements of an array; the alternative is the element type: f32, f64, i32 or u8.
using ArrayData = std::variant<std::vector<float>, std::vector<double>, std::vector<std::int32_t>,
                               std::vector<std::uint8_t>>;

/// An array in row-major order; the product of `shape` is the number of elements.
struct NamedArray {
    std::string name;
    std::vector<std::uint64_t> shape;
    ArrayData data;
};

/// What one file holds.
struct ArrayFile {
    nlohmann::json meta = nlohmann::json::object();  ///< free text and numbers that go with the arrays
    std::vector<NamedArray> arrays;                  ///< unique names

    /// Null when there is no such array.
    const NamedArray* find(const std::string& name) const;
};

/// The bytes of the file: a function of `file` alone (no time stamps, one thread, a fixed compression level).
/// std::logic_error when a shape does not fit its data or two arrays share a name.
std::vector<std::byte> encode_array_file(const ArrayFile& file);

/// Reads any bytes, sound or not, using memory in proportion to what is really there. InputError with
/// `file_name` and what is wrong.
ArrayFile decode_array_file(std::span<const std::byte> bytes, const std::string& file_name);

/// The elements of the array `name`, which must have element type T and `shape`, where 0 stands for any
/// length. InputError with `file_name` when it is absent or of another type or shape.
template <class T>
const std::vector<T>& required_array(const ArrayFile& file, const std::string& name,
                                     const std::vector<std::uint64_t>& shape, const std::string& file_name);

}  // namespace windfall::take
