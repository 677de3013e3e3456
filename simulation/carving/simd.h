// Vectors of eight numbers for the inner loops of milling. These are the compiler's own vectors: plain
// C++ operators act on each lane, every target has them, and a function with a wider instruction set does
// them in fewer instructions. So one text serves every InstructionSet and gives the same bits in each.
//
// Everything here must be inlined into the function that chose the instructions: take and return vectors only
// in always-inlined functions, never in a lambda.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace osteomill::simd {

inline constexpr std::size_t width = 8;

using Floats [[gnu::vector_size(32)]] = float;
using Ints [[gnu::vector_size(32)]] = std::int32_t;
using HalfInts [[gnu::vector_size(16)]] = std::int32_t;
using Bytes [[gnu::vector_size(16)]] = std::uint8_t;

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
    return Floats{value, value, value, value, value, value, value, value};
}
[[gnu::always_inline]] inline Ints counting() {
    return Ints{0, 1, 2, 3, 4, 5, 6, 7};
}
[[gnu::always_inline]] inline Bytes counting_bytes() {
    return Bytes{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
}
[[gnu::always_inline]] inline Floats to_floats(const Ints& v) {
    return __builtin_convertvector(v, Floats);
}

/// Positions or directions of eight.
struct Floats3 {
    Floats x;
    Floats y;
    Floats z;
};
/// The same value eight times. Stored as vectors, constants are memory operands; otherwise a register would
/// be loaded for each.
[[gnu::always_inline]] inline Floats3 floats3(const glm::vec3& v) {
    return {floats(v.x), floats(v.y), floats(v.z)};
}

[[gnu::always_inline]] inline Ints smaller(const Ints& a, const Ints& b) {
    return a < b ? a : b;
}
[[gnu::always_inline]] inline Ints larger(const Ints& a, const Ints& b) {
    return a < b ? b : a;
}

[[gnu::always_inline]] inline Floats smaller(const Floats& a, const Floats& b) {
    return a < b ? a : b;
}
[[gnu::always_inline]] inline Floats larger(const Floats& a, const Floats& b) {
    return a < b ? b : a;
}

[[gnu::always_inline]] inline HalfInts low_half(const Ints& v) {
    return __builtin_shufflevector(v, v, 0, 1, 2, 3);
}
[[gnu::always_inline]] inline HalfInts high_half(const Ints& v) {
    return __builtin_shufflevector(v, v, 4, 5, 6, 7);
}
// The compiler makes one instruction of each.
[[gnu::always_inline]] inline Floats magnitude(const Floats& v) {
    Floats size;
    for (int i = 0; i < 8; ++i) size[i] = std::abs(v[i]);
    return size;
}
/// `size`, which is not negative, with the other's sign.
[[gnu::always_inline]] inline Floats with_sign_of(const Floats& sign, const Floats& size) {
    Floats v;
    for (int i = 0; i < 8; ++i) v[i] = std::copysign(size[i], sign[i]);
    return v;
}
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

/// Sixteen bytes: 0 from `first` on for `count`, else 255. `first` + `count` <= 16.
[[gnu::always_inline]] inline Bytes outside(std::size_t first, std::size_t count) {
    static constexpr std::array<std::uint8_t, 48> window = [] {
        std::array<std::uint8_t, 48> bytes{};
        for (std::size_t i = 0; i < 16; ++i) bytes[i] = bytes[32 + i] = 255;
        return bytes;
    }();
    return load<Bytes>(&window[16 - first]) | load<Bytes>(&window[32 - first - count]);
}
[[gnu::always_inline]] inline Bytes smaller(const Bytes& a, const Bytes& b) {
    return a < b ? a : b;
}

/// Bit i is set where byte i of sixteen is not equal.
[[gnu::always_inline]] inline unsigned bits_of_unequal(const Bytes& a, const Bytes& b) {
#if defined(__SSE2__)
    const __m128i equal =
        _mm_cmpeq_epi8(reinterpret_cast<const __m128i&>(a), reinterpret_cast<const __m128i&>(b));
    return static_cast<unsigned>(_mm_movemask_epi8(equal)) ^ 0xffffu;
#else
    unsigned bits = 0;
    for (unsigned i = 0; i < sizeof a; ++i) bits |= (a[i] != b[i] ? 1u : 0u) << i;
    return bits;
#endif
}

/// Eight bytes as numbers.
[[gnu::always_inline]] inline Ints load_bytes(const std::uint8_t* from) {
#if defined(__SSE2__)
    const __m128i zero = _mm_setzero_si128();
    const __m128i words = _mm_unpacklo_epi8(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)), zero);
    return __builtin_shufflevector(reinterpret_cast<HalfInts>(_mm_unpacklo_epi16(words, zero)),
                                   reinterpret_cast<HalfInts>(_mm_unpackhi_epi16(words, zero)), 0, 1, 2, 3, 4,
                                   5, 6, 7);
#else
    Ints numbers;
    for (int i = 0; i < 8; ++i) numbers[i] = from[i];
    return numbers;
#endif
}
/// Eight numbers of 0 to 255 as bytes.
[[gnu::always_inline]] inline void store_bytes(std::uint8_t* to, const Ints& numbers) {
#if defined(__SSE2__)
    const HalfInts low = low_half(numbers);
    const HalfInts high = high_half(numbers);
    const __m128i words =
        _mm_packs_epi32(reinterpret_cast<const __m128i&>(low), reinterpret_cast<const __m128i&>(high));
    _mm_storel_epi64(reinterpret_cast<__m128i*>(to), _mm_packus_epi16(words, words));
#else
    for (int i = 0; i < 8; ++i) to[i] = static_cast<std::uint8_t>(numbers[i]);
#endif
}

/// For each choice among eight lanes, those that are chosen, the first of them first; then any.
inline constexpr auto chosen_lanes = [] {
    std::array<std::array<std::uint8_t, width>, 256> lanes{};
    for (unsigned choice = 0; choice < lanes.size(); ++choice) {
        std::size_t count = 0;
        for (unsigned lane = 0; lane < width; ++lane)
            if ((choice >> lane & 1u) != 0) lanes[choice][count++] = static_cast<std::uint8_t>(lane);
    }
    return lanes;
}();

/// Stores the lanes where `is_chosen` is -1 side by side, and then anything, eight lanes in all. Returns how
/// many were chosen.
template <typename Scalar>
[[gnu::always_inline]] inline std::size_t store_chosen(const Ints& is_chosen, const Ints& v, Scalar* to) {
    const unsigned choice = bits_of(is_chosen);
    const Ints from = load_bytes(chosen_lanes[choice].data());
#if defined(__clang__)
    Ints chosen;
    for (int i = 0; i < 8; ++i) chosen[i] = v[from[i]];
#else
    const Ints chosen = __builtin_shuffle(v, from);
#endif
    store(to, chosen);
    return static_cast<std::size_t>(std::popcount(choice));
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
