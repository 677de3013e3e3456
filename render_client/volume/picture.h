// A picture in memory: 8-bit sRGB, the first row on top.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace osteomill {

struct Picture {
    explicit Picture(const glm::ivec2& size) : size_px(size), rgb(3u * size.x * size.y) {}

    /// First of the three bytes of a pixel; x from the left, y from the top.
    const std::uint8_t* at(int x, int y) const {
        return rgb.data() + 3 * (static_cast<std::size_t>(y) * size_px.x + x);
    }

    glm::ivec2 size_px;
    std::vector<std::uint8_t> rgb;

    bool operator==(const Picture&) const = default;
};

/// Quality of the displayed picture: full, or reduced for speed.
struct PictureQuality {
    double scale = 1.0;   ///< resolution of the coarsest part, as a share of the picture's: 1 down to 1/4
    bool refined = true;  ///< every pixel is that of a full-quality picture

    bool operator==(const PictureQuality&) const = default;
};

// Pictures as PNG files (libpng), written fast and without a wait for the disk: of 8-bit RGB, or of indices
// into a table of colours.

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
