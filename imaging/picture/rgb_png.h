// A picture of 8-bit RGB as a PNG file (libpng).
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <span>

#include "common/files/atomic_file.h"

namespace osteomill {

/// `rgb`: three bytes a pixel, rows from above. Replaces the file as a whole. Throws std::runtime_error, in
/// one line naming the file, if it cannot be written.
void write_rgb_png(std::span<const std::uint8_t> rgb, const glm::ivec2& size_px,
                   const std::filesystem::path& path, Link link = Link::follow);

}  // namespace osteomill
