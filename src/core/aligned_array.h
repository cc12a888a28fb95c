#pragma once
// Large flat arrays for the hot loops: 128-byte aligned, zero at first, on huge pages where the system gives
// them. Large ones are mapped, so that nobody writes zeros that the system has written already, and pages
// come to be in the loops that first write them.
#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
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
        if (size == 0) return;
        if (size * sizeof(T) >= kMapped) {
            map(size * sizeof(T));
            return;
        }
        const std::size_t bytes = rounded_up(size * sizeof(T), kAlignment);
        m_data = Pointer(static_cast<T*>(std::aligned_alloc(kAlignment, bytes)), Free{});
        if (!m_data) throw std::bad_alloc();
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
    static constexpr std::size_t kAlignment = 128;
    static constexpr std::size_t kHugePage = std::size_t{2} << 20U;
    static constexpr std::size_t kMapped = 2 * kHugePage;

    struct Free {
        std::size_t mapped_bytes = 0;  ///< 0: from aligned_alloc
        void operator()(T* p) const {
            if (mapped_bytes > 0)
                munmap(p, mapped_bytes);
            else
                std::free(p);
        }
    };
    using Pointer = std::unique_ptr<T, Free>;

    static std::size_t rounded_up(std::size_t bytes, std::size_t unit) {
        return (bytes + unit - 1) / unit * unit;
    }
    /// Maps whole huge pages and gives back what lies beside them.
    void map(std::size_t wanted) {
        const std::size_t bytes = rounded_up(wanted, kHugePage);
        void* mapped =
            mmap(nullptr, bytes + kHugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (mapped == MAP_FAILED) throw std::bad_alloc();
        auto* first = static_cast<char*>(mapped);
        const std::size_t before =
            (kHugePage - reinterpret_cast<std::uintptr_t>(first) % kHugePage) % kHugePage;
        if (before > 0) munmap(first, before);
        munmap(first + before + bytes, kHugePage - before);
        madvise(first + before, bytes, MADV_HUGEPAGE);
        m_data = Pointer(reinterpret_cast<T*>(first + before), Free{bytes});
    }

    Pointer m_data;
    std::size_t m_size = 0;
};

}  // namespace windfall
