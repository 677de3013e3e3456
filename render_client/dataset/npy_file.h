// Arrays as NumPy's files (.npy, version 1.0): numpy.load reads them.
//
// Magic, version, length of the header, and the header as a Python literal, padded to 64 bytes; then the
// numbers as they lie in memory, little-endian, the last index fastest (NumPy Enhancement Proposal 1).
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace osteomill {

/// float32 of shape (height, width). Replaces the file as a whole. Throws std::runtime_error naming the file
/// if it cannot be written, or std::invalid_argument if there are not as many values as pixels.
void write_npy(const glm::ivec2& size_px, std::span<const float> values, const std::filesystem::path& file);
/// The three numbers of each as float16, one after the other.
std::vector<std::uint16_t> halves_of(std::span<const glm::vec3> values);
/// float16 of shape (height, width, 3).
void write_npy(const glm::ivec2& size_px, std::span<const glm::vec3> values,
               const std::filesystem::path& file);

}  // namespace osteomill
