// The files of an image set's images: DIR/CAMERA/FRAME_KIND.png or .npy.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "render_client/dataset/session_images.h"
#include "render_client/ui/dataset_options.h"

namespace osteomill {

/// Colours of a table of labels, for an indexed picture.
std::vector<std::array<std::uint8_t, 3>> colours_of(const std::vector<SurfaceLabel>& labels);

/// Depths along each pixel's ray from depths along the axis, mm.
std::vector<float> along_rays(const SurfaceImage& surface, const Pinhole& pinhole);

/// Writes what `options` asks for; the camera's pose and, by kind, the names of the files relative to the
/// set's folder. Throws std::runtime_error naming a file that cannot be written.
nlohmann::ordered_json write_images(const DatasetOptions& options, std::size_t frame,
                                    const DatasetCamera& camera, const CameraImages& images,
                                    const std::vector<std::array<std::uint8_t, 3>>& colours_rgb);

}  // namespace osteomill
