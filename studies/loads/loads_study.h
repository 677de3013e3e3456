// Removal rate by load and material, in a table: osteomill_study force --loads.
#pragma once

#include <filesystem>

#include "analysis/output/surroundings.h"

namespace osteomill::study {

/// Presses a 1.5 mm burr of six edges at 40 000 rpm, led at 4 mm/s, with 0.34, 0.64 and 1.05 N (a dentist's
/// least, middle and most) on the materials of scenes/materials.toml, under the full law and under the
/// published one. Writes loads.csv into `out`, a folder that is there, and says it as a table. Throws
/// std::runtime_error in one line naming what cannot be written.
void run_loads_study(const std::filesystem::path& out, const StudySurroundings& surroundings);

}  // namespace osteomill::study
