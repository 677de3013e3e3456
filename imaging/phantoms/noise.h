// Irregularity that is the same everywhere: noise on a lattice, of whole numbers, so that every compiler and
// optimisation gives the same bits.
#pragma once

#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace osteomill {

/// A whole number from a lattice point, well mixed (splitmix64), as a share of 1 between -1 and 1. Right for
/// coordinates within 4096 of zero.
inline double lattice_noise(const glm::ivec3& point) {
    auto bits = static_cast<std::uint64_t>(point.x + 4096) +
                (static_cast<std::uint64_t>(point.y + 4096) << 16U) +
                (static_cast<std::uint64_t>(point.z + 4096) << 32U);
    bits += 0x9e3779b97f4a7c15U;
    bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9U;
    bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebU;
    bits ^= bits >> 31U;
    return static_cast<double>(bits >> 11U) / static_cast<double>(1ULL << 52U) - 1.0;
}

/// Value between the lattice's points; `weight` are the shares of the next point along each axis, 0 to 1.
inline double noise_between(const glm::dvec3& base, const glm::dvec3& weight) {
    const glm::ivec3 first(base);
    const glm::dvec3 rest = 1.0 - weight;
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 step(corner & 1, (corner >> 1) & 1, corner >> 2);
        sum += (step.x ? weight.x : rest.x) * (step.y ? weight.y : rest.y) * (step.z ? weight.z : rest.z) *
               lattice_noise(first + step);
    }
    return sum;
}

/// Trilinear between points of distance 1: continuous, with creases.
inline double linear_noise(const glm::dvec3& at) {
    const glm::dvec3 base = glm::floor(at);
    return noise_between(base, at - base);
}

/// Without creases.
inline double smooth_noise(const glm::dvec3& at) {
    const glm::dvec3 base = glm::floor(at);
    const glm::dvec3 w = at - base;
    return noise_between(base, w * w * (3.0 - 2.0 * w));
}

}  // namespace osteomill
