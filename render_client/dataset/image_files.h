// The files of an image set's images: DIR/CAMERA/FRAME_KIND.png or .npy.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "render_client/dataset/dataset_contents.h"
#include "render_client/dataset/session_images.h"

namespace osteomill {

/// Colours of a table of labels, for an indexed picture.
std::vector<std::array<std::uint8_t, 3>> colours_of(const std::vector<SurfaceLabel>& labels);

/// Depths along each pixel's ray from depths along the axis, mm.
std::vector<float> along_rays(const SurfaceImage& surface, const Pinhole& pinhole);

/// Writes those that are wanted; by kind, the names of their files relative to the set's folder. Throws
/// std::runtime_error naming a file that cannot be written.
nlohmann::ordered_json write_images(const std::filesystem::path& folder, const DatasetImages& wanted,
                                    std::size_t frame, const std::string& camera, const CameraImages& images,
                                    const std::vector<std::array<std::uint8_t, 3>>& colours_rgb);

// Arrays as NumPy's files (.npy, version 1.0): numpy.load reads them.
//
// Magic, version, length of the header, and the header as a Python literal, padded to 64 bytes; then the
// numbers as they lie in memory, little-endian, the last index fastest (NumPy Enhancement Proposal 1).

/// float32 of shape (height, width). Replaces the file as a whole. Throws std::runtime_error naming the file
/// if it cannot be written, or std::invalid_argument if there are not as many values as pixels.
void write_npy(const glm::ivec2& size_px, std::span<const float> values, const std::filesystem::path& file);
/// The three numbers of each as float16, one after the other.
std::vector<std::uint16_t> halves_of(std::span<const glm::vec3> values);
/// float16 of shape (height, width, 3).
void write_npy(const glm::ivec2& size_px, std::span<const glm::vec3> values,
               const std::filesystem::path& file);

}  // namespace osteomill
