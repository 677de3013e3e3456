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

}  // namespace osteomill
