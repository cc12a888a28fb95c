#pragma once
// Writes and reads the state of a body as bytes of this machine.
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "core/aligned_array.h"
#include "core/error.h"

namespace windfall::decay {

/// Appends numbers and arrays of numbers, each array behind its length.
class BodyWriter {
  public:
    static constexpr bool kReading = false;

    template <class T>
    requires std::is_arithmetic_v<T>
    void operator()(const T& value) { append(&value, 1); }
    template <class T>
    void operator()(const std::vector<T>& values) {
        (*this)(static_cast<std::uint64_t>(values.size()));
        append(values.data(), values.size());
    }
    template <class T>
    void operator()(const AlignedArray<T>& values) {
        (*this)(static_cast<std::uint64_t>(values.size()));
        append(values.data(), values.size());
    }
    std::vector<std::byte> take() { return std::move(m_bytes); }

  private:
    template <class T>
    void append(const T* values, std::size_t count) {
        const auto* begin = reinterpret_cast<const std::byte*>(values);
        m_bytes.insert(m_bytes.end(), begin, begin + count * sizeof(T));
    }
    std::vector<std::byte> m_bytes;
};

/// The way back. Throws InputError where the bytes end early or an array has another length than the one it
/// is read into; only empty arrays take any length.
class BodyReader {
  public:
    static constexpr bool kReading = true;

    explicit BodyReader(std::span<const std::byte> bytes) : m_bytes(bytes) {}

    template <class T>
    requires std::is_arithmetic_v<T>
    void operator()(T& value) { extract(&value, 1); }
    template <class T>
    void operator()(std::vector<T>& values) {
        const std::uint64_t size = read_size(sizeof(T));
        if (!values.empty() && values.size() != size) fail();
        values.resize(size);
        extract(values.data(), size);
    }
    template <class T>
    void operator()(AlignedArray<T>& values) {
        if (read_size(sizeof(T)) != values.size()) fail();
        extract(values.data(), values.size());
    }
    bool at_end() const { return m_bytes.empty(); }

  private:
    [[noreturn]] static void fail() {
        throw InputError(
            "the saved state is of another body: settings, surface and version must be the same");
    }
    std::uint64_t read_size(std::size_t item) {
        std::uint64_t size = 0;
        (*this)(size);
        if (size > m_bytes.size() / item) fail();
        return size;
    }
    template <class T>
    void extract(T* values, std::size_t count) {
        const std::size_t wanted = count * sizeof(T);
        if (wanted > m_bytes.size()) fail();
        if (wanted > 0) std::memcpy(static_cast<void*>(values), m_bytes.data(), wanted);
        m_bytes = m_bytes.subspan(wanted);
    }
    std::span<const std::byte> m_bytes;
};

}  // namespace windfall::decay
