// Logs of a session as CSV: its haptic ticks, and its milling steps.
#pragma once

#include "analysis/logs/csv_log.h"
#include "common/session/tick_sample.h"
#include "simulation/loop/milling_sample.h"

namespace osteomill {

using ForceLog = CsvLog<TickSample>;
using MillingLog = CsvLog<MillingSample>;

}  // namespace osteomill
