// The study of the pictures: speed against accuracy, and how smooth a cut looks.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>

#include "analysis/output/surroundings.h"

namespace osteomill::study {

struct RenderStudyOptions {
    std::filesystem::path out;
    bool full_rate_only = false;                   ///< only frames a second in a large window, full_rate.h
    std::optional<int> frames{};                   ///< of these, in a row of the table; none: 600
    std::optional<int> gpu{};                      ///< draw on this GPU of several, from 0
    bool quick = false;                            ///< fewer settings, smaller pictures: under a minute
    std::optional<glm::ivec2> size_px{};           ///< of the pictures; none: 640 x 480, 240 x 180 if quick
    std::optional<std::filesystem::path> scans{};  ///< a folder of trial scans; none: the phantom alone
};

/// Writes render.json, accuracy.csv and its chart into `options.out`. Throws
/// std::runtime_error in one line naming what cannot be written or read, and gl::NoOpenGl.
void run_render_study(const RenderStudyOptions& options, const StudySurroundings& surroundings);

}  // namespace osteomill::study
