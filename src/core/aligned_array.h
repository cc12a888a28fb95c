#pragma once
// Large flat arrays for the hot loops: 128-byte aligned, zero at first, on huge pages where the system gives
// them.
#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace windfall {

template <class T>
class AlignedArray {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    AlignedArray() = default;
    explicit AlignedArray(std::size_t size) : m_size(size) {
        constexpr std::size_t kHugePage = std::size_t{2} << 20U;
        const std::size_t wanted = size * sizeof(T);
        const std::size_t alignment = wanted >= 2 * kHugePage ? kHugePage : 128;
        const std::size_t bytes = (wanted + alignment - 1) / alignment * alignment;
        if (bytes == 0) return;
        m_data.reset(static_cast<T*>(std::aligned_alloc(alignment, bytes)));
        if (!m_data) throw std::bad_alloc();
        if (alignment == kHugePage) madvise(m_data.get(), bytes, MADV_HUGEPAGE);
        set_zero();
    }
    AlignedArray(const AlignedArray& other) : AlignedArray(other.m_size) {
        if (m_size > 0) std::memcpy(data(), other.data(), m_size * sizeof(T));
    }
    AlignedArray(AlignedArray&& other) noexcept
        : m_data(std::move(other.m_data)), m_size(std::exchange(other.m_size, 0)) {}
    AlignedArray& operator=(const AlignedArray& other) {
        if (this != &other) *this = AlignedArray(other);
        return *this;
    }
    AlignedArray& operator=(AlignedArray&& other) noexcept {
        std::swap(m_data, other.m_data);
        std::swap(m_size, other.m_size);
        return *this;
    }
    ~AlignedArray() = default;

    T* data() { return m_data.get(); }
    const T* data() const { return m_data.get(); }
    std::size_t size() const { return m_size; }
    T& operator[](std::size_t i) { return m_data.get()[i]; }
    const T& operator[](std::size_t i) const { return m_data.get()[i]; }
    T* begin() { return data(); }
    T* end() { return data() + m_size; }
    const T* begin() const { return data(); }
    const T* end() const { return data() + m_size; }
    void set_zero() {
        if (m_size > 0) std::memset(static_cast<void*>(m_data.get()), 0, m_size * sizeof(T));
    }

  private:
    struct Free {
        void operator()(T* p) const { std::free(p); }
    };
    std::unique_ptr<T, Free> m_data;
    std::size_t m_size = 0;
};

}  // namespace windfall
