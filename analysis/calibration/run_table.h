// Table of runs on a dynamometer, and what a line of it says: one straight slot of a spherical burr, its mean
// force and how well that is known.
//
// The frame of a run: x along the feed (the burr's velocity relative to the specimen), z up, out of the flat
// specimen, y across = up x feed, to the left of who looks along the feed. The force is that of the bone on
// the burr; a dynamometer under the specimen feels the opposite.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/burr.h"

namespace osteomill::study {

/// How a run was cut.
struct RunSetting {
    double diameter_mm = 4.0;
    int edges = 8;
    SpindleSense turns = SpindleSense::clockwise;
    double rpm = 20'000.0;
    double feed_mm_per_s = 6.0;
    double depth_mm = 0.5;            ///< of the sphere's lowest point below the flat surface
    double tilt_deg = 0.0;            ///< of the spindle from upright
    double tilt_direction_deg = 0.0;  ///< where the shank leans: 0 ahead along the feed, 90 to the left of it
    /// The same burr has cut along the same line before, that much higher; a fresh slot without it.
    std::optional<double> previous_groove_mm_higher{};
};

struct MeasuredRun {
    std::string name{};
    std::string material{};
    RunSetting setting{};
    glm::dvec3 force_n{0.0};   ///< mean, of the bone on the burr: feed, across, up
    glm::dvec3 spread_n{0.0};  ///< standard deviation of that mean
};

/// Reads a table: comma-separated values, the first line names the columns, in any order; lines that are
/// empty or begin with # are passed over.
///     run                     text, each once
///     material                text; a fit is made for each
///     diameter_mm             0.2 to 20
///     edges                   whole, 1 to 64
///     turns                   clockwise or counter-clockwise, seen from the handpiece
///     rpm                     100 to 500 000
///     feed_mm_per_s           above 0, at most 1000
///     depth_mm                above 0, at most the radius: above the equator the shank rubs
///     tilt_deg                0 to 85
///     tilt_direction_deg      -360 to 360
///     previous_groove_mm_higher   above 0, or empty; the column may be missing
///     force_feed_n, force_across_n, force_up_n      numbers
///     spread_feed_n, spread_across_n, spread_up_n   above 0
/// Throws std::runtime_error in one line, FILE:LINE, what is wrong and what would be right: for a file that
/// cannot be read or holds no run, a column that is unknown, missing or there twice, a line with too few or
/// too many values, a value that is none of the above.
std::vector<MeasuredRun> read_runs(const std::filesystem::path& file);

/// The table of runs that are still to be made: no forces, no spreads.
std::string table_to_fill_in(const std::vector<RunSetting>& settings, const std::string& material);

}  // namespace osteomill::study
