// The files of an image set's images: DIR/CAMERA/FRAME_KIND.png or .npy.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
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

}  // namespace osteomill
