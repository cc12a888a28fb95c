// Vectors of L lanes, as GCC and Clang vector types. Included inside the namespace of one instruction set,
// with <immintrin.h> before it, and never by anything else: the same text compiled with other flags is other
// code.

template <int L>
struct LaneTypes;

template <>
struct LaneTypes<8> {
    typedef float F __attribute__((vector_size(32), may_alias));
    typedef double D __attribute__((vector_size(64), may_alias));
    typedef long long I __attribute__((vector_size(64), may_alias));
};

template <>
struct LaneTypes<16> {
    typedef float F __attribute__((vector_size(64), may_alias));
    typedef double D __attribute__((vector_size(128), may_alias));
    typedef long long I __attribute__((vector_size(128), may_alias));
};

template <int L>
using LaneFloats = typename LaneTypes<L>::F;

// Lane k of the result is lane k - 1 of `a` (shift_up) or k + 1 (shift_down); zero comes in at the end.
template <class V>
inline V shift_up(V a) {
    const V zero = a - a;
    if constexpr (sizeof(V) / sizeof(a[0]) == 8) {
        return __builtin_shufflevector(a, zero, 8, 0, 1, 2, 3, 4, 5, 6);
    } else {
        return __builtin_shufflevector(a, zero, 16, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14);
    }
}

template <class V>
inline V shift_down(V a) {
    const V zero = a - a;
    if constexpr (sizeof(V) / sizeof(a[0]) == 8) {
        return __builtin_shufflevector(a, zero, 1, 2, 3, 4, 5, 6, 7, 8);
    } else {
        return __builtin_shufflevector(a, zero, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16);
    }
}

template <int L>
inline typename LaneTypes<L>::F load_half(const std::uint16_t* p) {
    union {
        typename LaneTypes<L>::F vector;
        __m256 parts[L / 8];
    } result;
    for (int part = 0; part < L / 8; ++part)
        result.parts[part] = _mm256_cvtph_ps(_mm_load_si128(reinterpret_cast<const __m128i*>(p + 8 * part)));
    return result.vector;
}

template <int L>
inline void store_half(std::uint16_t* p, typename LaneTypes<L>::F value) {
    union {
        typename LaneTypes<L>::F vector;
        __m256 parts[L / 8];
    } source;
    source.vector = value;
    for (int part = 0; part < L / 8; ++part)
        _mm_store_si128(reinterpret_cast<__m128i*>(p + 8 * part), _mm256_cvtps_ph(source.parts[part], 0));
}

template <class V>
inline double sum_of_lanes(V a) {
    double sum = 0;
    for (unsigned k = 0; k < sizeof(V) / sizeof(a[0]); ++k) sum += a[k];
    return sum;
}

/// Natural logarithm of positive lanes: x = 2^e m with m in [sqrt(1/2), sqrt(2)), ln m = 2
/// artanh((m-1)/(m+1)) by its series in s^2 to the 19th power, |s| <= 0.172: truncation below 1e-17.
template <int L>
inline typename LaneTypes<L>::D log_lanes(typename LaneTypes<L>::D x) {
    using D = typename LaneTypes<L>::D;
    using I = typename LaneTypes<L>::I;
    union {
        D real;
        I bits;
    } u;
    u.real = x;
    constexpr long long kSqrtHalf = 0x3FE6A09E667F3BCDLL;
    const I shifted = u.bits - kSqrtHalf;
    const I exponent = shifted >> 52;
    u.bits = (shifted & 0x000FFFFFFFFFFFFFLL) + kSqrtHalf;
    const D m = u.real;
    const D e = __builtin_convertvector(exponent, D);
    const D s = (m - 1.0) / (m + 1.0);
    const D t = s * s;
    D series = t * (1.0 / 19) + 1.0 / 17;
    series = series * t + 1.0 / 15;
    series = series * t + 1.0 / 13;
    series = series * t + 1.0 / 11;
    series = series * t + 1.0 / 9;
    series = series * t + 1.0 / 7;
    series = series * t + 1.0 / 5;
    series = series * t + 1.0 / 3;
    constexpr double kLn2High = 6.93147180369123816490e-01;
    constexpr double kLn2Low = 1.90821492927058770002e-10;
    return e * kLn2High + (e * kLn2Low + 2.0 * s * t * series + 2.0 * s);
}
