// Pictures as PNG files (libpng): of 8-bit RGB, or of indices into a table of colours.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>

#include "render_client/volume/picture.h"

namespace osteomill {

/// Replaces the file as a whole. Throws std::runtime_error, naming the file, if it cannot be written.
void write_png(const Picture& picture, const std::filesystem::path& file);

/// `indices` a pixel into `colours_rgb`, at most 256; otherwise the same.
void write_indexed_png(const glm::ivec2& size_px, std::span<const std::uint8_t> indices,
                       std::span<const std::array<std::uint8_t, 3>> colours_rgb,
                       const std::filesystem::path& file);

/// Throws std::runtime_error, naming the file, if it cannot be read.
Picture read_png(const std::filesystem::path& file);
/// Reads a PNG file's bytes.
Picture read_png(std::span<const std::uint8_t> bytes);

}  // namespace osteomill
