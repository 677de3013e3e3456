// Full rate: how many frames a second a graphics card draws in full quality, in a large window, with what a
// carve costs to upload and what the textures take. One command for a machine
// with a GPU; on a software rasteriser less of everything, and it says so.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>

#include "analysis/output/surroundings.h"

namespace osteomill::study {

struct FullRateOptions {
    std::filesystem::path out{};
    std::optional<glm::ivec2> size_px{};  ///< none: 2560 x 1440, 640 x 360 on a software rasteriser
    std::optional<int> frames{};          ///< of each row; none: 600, 8 on a software rasteriser
    std::optional<int> gpu{};             ///< as of OffscreenContext
};

/// Writes full_rate.json, full_rate.csv, render_full_rate.svg and pictures into `options.out`, a folder that
/// is there. Throws std::runtime_error in one line, and gl::NoOpenGl.
void measure_full_rate(const FullRateOptions& options, const StudySurroundings& surroundings);

}  // namespace osteomill::study
