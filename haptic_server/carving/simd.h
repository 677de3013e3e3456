// Vectors of eight numbers for the inner loops of milling. These are the compiler's own vectors: plain
// C++ operators act on each lane, every target has them, and a function with a wider instruction set does
// them in fewer instructions. So one text serves every InstructionSet and gives the same bits in each.
//
// Everything here must be inlined into the function that chose the instructions: take and return vectors only
// in always-inlined functions, never in a lambda.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace osteomill::simd {

inline constexpr std::size_t width = 8;

using Floats [[gnu::vector_size(32)]] = float;
using Ints [[gnu::vector_size(32)]] = std::int32_t;
using HalfInts [[gnu::vector_size(16)]] = std::int32_t;

template <typename Lanes, typename Scalar>
[[gnu::always_inline]] inline Lanes load(const Scalar* from) {
    Lanes lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

template <typename Scalar, typename Lanes>
[[gnu::always_inline]] inline void store(Scalar* to, const Lanes& lanes) {
    std::memcpy(to, &lanes, sizeof lanes);
}

[[gnu::always_inline]] inline Ints ints(std::int32_t value) {
    return Ints{} + value;
}
[[gnu::always_inline]] inline Floats floats(float value) {
    return Floats{} + value;
}
[[gnu::always_inline]] inline Ints counting() {
    return Ints{0, 1, 2, 3, 4, 5, 6, 7};
}
[[gnu::always_inline]] inline Floats to_floats(const Ints& v) {
    return __builtin_convertvector(v, Floats);
}

[[gnu::always_inline]] inline Ints smaller(const Ints& a, const Ints& b) {
    return a < b ? a : b;
}
[[gnu::always_inline]] inline Ints larger(const Ints& a, const Ints& b) {
    return a < b ? b : a;
}

[[gnu::always_inline]] inline HalfInts low_half(const Ints& v) {
    return __builtin_shufflevector(v, v, 0, 1, 2, 3);
}
[[gnu::always_inline]] inline HalfInts high_half(const Ints& v) {
    return __builtin_shufflevector(v, v, 4, 5, 6, 7);
}
/// The compiler makes one instruction of it.
[[gnu::always_inline]] inline Floats square_root(const Floats& v) {
    Floats root;
    for (int i = 0; i < 8; ++i) root[i] = std::sqrt(v[i]);
    return root;
}

/// Whether a bit is set in some lane.
[[gnu::always_inline]] inline bool any(const Ints& v) {
    const HalfInts four = low_half(v) | high_half(v);
#if defined(__SSE2__)
    const auto bytes_without = _mm_cmpeq_epi8(reinterpret_cast<const __m128i&>(four), _mm_setzero_si128());
    return _mm_movemask_epi8(bytes_without) != 0xffff;
#else
    return (four[0] | four[1] | four[2] | four[3]) != 0;
#endif
}

/// Bit i is set where lane i, 0 or -1, is -1.
[[gnu::always_inline]] inline unsigned bits_of(const Ints& is) {
#if defined(__SSE2__)
    const HalfInts low = low_half(is);
    const HalfInts high = high_half(is);
    const __m128i words =
        _mm_packs_epi32(reinterpret_cast<const __m128i&>(low), reinterpret_cast<const __m128i&>(high));
    return static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(words, _mm_setzero_si128())));
#else
    const Ints bits = is & Ints{1, 2, 4, 8, 16, 32, 64, 128};
    const HalfInts four = low_half(bits) | high_half(bits);
    const HalfInts two = four | __builtin_shufflevector(four, four, 2, 3, 0, 1);
    return static_cast<unsigned>(two[0] | two[1]);
#endif
}

/// Largest of the eight.
[[gnu::always_inline]] inline std::int32_t largest(const Ints& v) {
    const HalfInts low = low_half(v);
    const HalfInts high = high_half(v);
    const HalfInts four = low < high ? high : low;
    const HalfInts swapped = __builtin_shufflevector(four, four, 2, 3, 0, 1);
    const HalfInts two = four < swapped ? swapped : four;
    return two[0] < two[1] ? two[1] : two[0];
}
[[gnu::always_inline]] inline std::int32_t smallest(const Ints& v) {
    return -largest(-v);
}

/// Sum of the eight, in the order of the lanes.
[[gnu::always_inline]] inline double sum(const Floats& v) {
    double total = 0.0;
    for (int i = 0; i < 8; ++i) total += static_cast<double>(v[i]);
    return total;
}

}  // namespace osteomill::simd
