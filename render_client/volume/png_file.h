// Pictures as PNG files (libpng, 8-bit RGB).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "render_client/volume/picture.h"

namespace osteomill {

/// Replaces the file as a whole. Throws std::runtime_error naming the file where it cannot be written.
void write_png(const Picture& picture, const std::filesystem::path& file);

/// Throws std::runtime_error naming the file where it cannot be read.
Picture read_png(const std::filesystem::path& file);
/// The same of a file's bytes.
Picture read_png(std::span<const std::uint8_t> bytes);

}  // namespace osteomill
