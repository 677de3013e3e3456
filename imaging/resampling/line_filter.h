// Filter along every line of an image, in place: the parts of separable filters.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "imaging/in_parallel.h"

namespace osteomill {

/// Calls filter(line), which changes the values of a line along `axis` (0: x), for each such line, on all
/// cores. `size` counts voxels; values lie x fastest, then y, then z. `pause` is called between rows, from
/// any thread, so that memory that was touched can be let go.
template <typename Filter>
void filter_lines(
    const glm::ivec3& size, std::span<float> values, int axis, const Filter& filter,
    const std::function<void()>& pause = [] {}) {
    const auto nx = static_cast<std::size_t>(size.x);
    const auto ny = static_cast<std::size_t>(size.y);
    const auto length = static_cast<std::size_t>(size[axis]);
    // A sheet holds the axis and, unless that is x, x: its lines are worked on next to each other, since they
    // lie next to each other in memory.
    const std::size_t step = axis == 0 ? 1 : axis == 1 ? nx : nx * ny;
    const int sheets = axis == 2 ? size.y : size.z;
    const std::size_t step_of_sheet = axis == 2 ? nx : nx * ny;
    const std::size_t lines = axis == 0 ? ny : nx;
    const std::size_t step_of_line = axis == 0 ? nx : 1;
    constexpr std::size_t values_at_once = 1u << 17;
    const std::size_t lines_at_once = std::clamp<std::size_t>(values_at_once / length, 1, lines);
    in_parallel(sheets, [&](int sheet) {
        float* first = values.data() + static_cast<std::size_t>(sheet) * step_of_sheet;
        std::vector<double> tile(lines_at_once * length);
        for (std::size_t begin = 0; begin < lines; begin += lines_at_once) {
            const std::size_t count = std::min(lines_at_once, lines - begin);
            float* corner = first + begin * step_of_line;
            for (std::size_t i = 0; i < length; ++i)
                for (std::size_t line = 0; line < count; ++line)
                    tile[line * length + i] = corner[i * step + line * step_of_line];
            for (std::size_t line = 0; line < count; ++line)
                filter(std::span(tile).subspan(line * length, length));
            for (std::size_t i = 0; i < length; ++i)
                for (std::size_t line = 0; line < count; ++line)
                    corner[i * step + line * step_of_line] = static_cast<float>(tile[line * length + i]);
        }
        pause();
    });
}

}  // namespace osteomill
