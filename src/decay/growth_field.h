#pragma once
#include <cstddef>
#include <span>

#include "core/aligned_array.h"

namespace windfall::decay {

/// One float a texel, zero at first, with zeros before the first and behind the last texel, so that the eight
/// neighbours of every texel may be read without asking whether they exist.
class TexelField {
  public:
    TexelField() = default;
    /// Fields that are read together should have different `slot`s: rows of a texture of 1024 or more texels
    /// lie whole pages apart, and all fields' rows would fall onto the same few lines of the first cache.
    explicit TexelField(int side, int slot = 0)
        : m_count(static_cast<std::size_t>(side) * side),
          m_pad((static_cast<std::size_t>(side) + 1 + kAlign - 1) / kAlign * kAlign + slot * kSlot),
          m_values(m_count + 2 * m_pad) {}

    float* data() { return m_values.data() + m_pad; }
    const float* data() const { return m_values.data() + m_pad; }
    float& operator[](std::size_t texel) { return data()[texel]; }
    float operator[](std::size_t texel) const { return data()[texel]; }
    std::size_t size() const { return m_count; }
    std::span<float> span() { return {data(), m_count}; }
    std::span<const float> span() const { return {data(), m_count}; }

  private:
    static constexpr std::size_t kAlign = 32;     // floats of one alignment of AlignedArray
    static constexpr std::size_t kSlot = 5 * 16;  // floats: five lines of the cache
    std::size_t m_count = 0, m_pad = 0;
    AlignedArray<float> m_values;
};

}  // namespace windfall::decay
