// A picture in memory: 8-bit sRGB, the first row on top.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
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

}  // namespace osteomill
