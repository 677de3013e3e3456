// The map as tables: all of it, and the curves of error.
#pragma once

#include "analysis/output/table.h"
#include "studies/stability/map/whole_map.h"

namespace osteomill::study {

/// A line a case, in the list's order: every value of it and of its outcome.
Table map_table_of(const WholeMap& map);

/// number,method,grip,resistance_n_s_per_m,rms_error_percent,stable: cutting at 1000 Hz without delay on an
/// ideal device, resistance ascending within a method and grip.
Table error_table_of(const WholeMap& map);

}  // namespace osteomill::study
