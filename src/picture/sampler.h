#pragma once
// Well spread sample points: Sobol' pairs, shuffled and scrambled by Owen's method with hashes.
// Burley, "Practical hash-based Owen scrambling", JCGT 9(4) (2020).
#include <array>
#include <cstdint>

namespace windfall::picture {

/// The points of one path. Every call of `next2` gives the next pair of dimensions, uniform in [0, 1).
class Sampler {
  public:
    Sampler(std::uint32_t pixel_key, std::uint32_t sample) : m_key(pixel_key), m_sample(sample) {}

    std::array<float, 2> next2() {
        m_key = hash(m_key + 0x9E3779B9U);
        // an order of the samples of its own for each pair, else the pairs would be correlated
        const std::uint32_t index = scrambled(m_sample, m_key ^ 0x68BC21EBU);
        return {to_unit(reversed(scrambled_reversed(index, hash(m_key ^ 0x02E5BE93U)))),
                to_unit(reversed(scrambled_reversed(pascal(index), hash(m_key ^ 0x967A889BU))))};
    }

  private:
    static std::uint32_t hash(std::uint32_t x) {
        x ^= x >> 16U;
        x *= 0x7FEB352DU;
        x ^= x >> 15U;
        x *= 0x846CA68BU;
        return x ^ x >> 16U;
    }
    static std::uint32_t reversed(std::uint32_t x) {
        x = __builtin_bswap32(x);
        x = (x & 0x0F0F0F0FU) << 4U | (x >> 4U & 0x0F0F0F0FU);
        x = (x & 0x33333333U) << 2U | (x >> 2U & 0x33333333U);
        return (x & 0x55555555U) << 1U | (x >> 1U & 0x55555555U);
    }
    /// Owen scrambling of numbers whose bits stand in reverse order (Laine and Karras 2011, Burley's
    /// constants).
    static std::uint32_t scrambled_reversed(std::uint32_t x, std::uint32_t key) {
        x += key;
        x ^= x * 0x6C50B47CU;
        x ^= x * 0xB82F1E52U;
        x ^= x * 0xC7AFE638U;
        return x ^ x * 0x8D22F6E6U;
    }
    static std::uint32_t scrambled(std::uint32_t x, std::uint32_t key) {
        return reversed(scrambled_reversed(reversed(x), key));
    }
    /// The second Sobol' dimension, bits reversed: the Pascal matrix modulo 2.
    static std::uint32_t pascal(std::uint32_t x) {
        x ^= x >> 1U & 0x55555555U;
        x ^= x >> 2U & 0x33333333U;
        x ^= x >> 4U & 0x0F0F0F0FU;
        x ^= x >> 8U & 0x00FF00FFU;
        return x ^ (x >> 16U & 0x0000FFFFU);
    }
    static float to_unit(std::uint32_t x) { return static_cast<float>(x >> 8U) * 0x1p-24F; }

    std::uint32_t m_key;
    std::uint32_t m_sample;
};

}  // namespace windfall::picture
