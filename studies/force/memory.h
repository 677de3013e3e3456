// Cost of a bone in memory and at start: it must follow the bone, not the box around it.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/output/progress.h"
#include "common/bone/bone.h"

namespace osteomill::study {

struct MemoryRow {
    std::string name{};
    double bone_mm3 = 0.0;
    double box_mm3 = 0.0;  ///< the grid's
    double mebibytes = 0.0;
    double bytes_per_mm3 = 0.0;  ///< of bone
    double start_s = 0.0;        ///< until the bone can be milled, from nothing or from its file
};

/// Times `make` and weighs what it makes.
MemoryRow weigh(const std::string& name, const std::function<Bone()>& make);

/// The bones that haptic_server starts with, and a region of 40 mm of `head_ct` where `scans` names the
/// folder of trial scans: imported to 0.1 mm first, then loaded as haptic_server loads it. `folder` holds the
/// imported file meanwhile.
std::vector<MemoryRow> weigh_scenes(const std::optional<std::filesystem::path>& scans,
                                    const std::filesystem::path& folder, const Progress& progress);

/// Solid cubes in boxes that fit, of 3.2 to 51.2 mm an edge.
std::vector<MemoryRow> weigh_growing_bone();

/// One solid cube of 12.8 mm in boxes of 12.8 to 102.4 mm an edge.
std::vector<MemoryRow> weigh_growing_box();

/// What it takes to watch protected structures (structure_watch.h): those of the tooth, and a made nerve of
/// 1.5 mm across and 30 mm. `bone_mm3` is the structures' volume, `box_mm3` the bone's box.
std::vector<MemoryRow> weigh_structures();

/// Table with a header.
std::string csv_of(const std::vector<MemoryRow>& rows);

}  // namespace osteomill::study
