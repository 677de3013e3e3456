// Cost of a bone in memory and at start: it must follow the bone, not the box around it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/output/table.h"

namespace osteomill::study {

struct MemoryRow {
    std::string name{};
    double bone_mm3 = 0.0;
    double box_mm3 = 0.0;  ///< the grid's
    double mebibytes = 0.0;
    double bytes_per_mm3 = 0.0;  ///< of bone
    double start_s = 0.0;        ///< until the bone can be milled
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MemoryRow, name, bone_mm3, box_mm3, mebibytes, bytes_per_mm3, start_s)

/// A phantom that haptic_server starts with.
MemoryRow weigh_scene(const std::string& phantom);

/// The watch of the tooth's protected structures (structure_watch.h). `bone_mm3` is the structures' volume,
/// `box_mm3` the bone's box.
MemoryRow weigh_structures();

Table table_of(const std::vector<MemoryRow>& rows);

}  // namespace osteomill::study
