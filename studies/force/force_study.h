// The study of the milling force: random motions, curves, the older contact models; its tables and charts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "analysis/output/surroundings.h"

namespace osteomill::study {

struct ForceStudyOptions {
    std::filesystem::path out;
    bool quick = false;  ///< fewer points and shorter runs: a minute at most
};

/// What random motions to draw.
struct RandomStudyOptions {
    std::filesystem::path out;
    int count = 500;
    std::uint64_t seed = 1;
    double voxel_mm = 0.1;
    std::optional<double> depth_mm{};  ///< of all; without, each has its own
    bool has_edge_forces = false;
    bool has_heads = false;  ///< other than balls
};

/// Runs random motions alone: writes random.json and random.csv into `options.out`. Throws as below.
void run_random_motions(const RandomStudyOptions& options, const StudySurroundings& surroundings);

/// Writes force.json, the tables (CSV) and the charts (SVG) into `options.out`.
/// Throws std::runtime_error in one line naming what cannot be written.
void run_force_study(const ForceStudyOptions& options, const StudySurroundings& surroundings);

}  // namespace osteomill::study
