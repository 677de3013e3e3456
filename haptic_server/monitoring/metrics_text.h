// A running session's figures in Prometheus' text format 0.0.4
// (https://prometheus.io/docs/instrumenting/exposition_formats/). Names and units: docs/operating.md.
#pragma once

#include <string>

#include "haptic_server/monitoring/tick_meter.h"
#include "haptic_server/streaming/streaming_server.h"

namespace osteomill {

std::string metrics_text(const TickMeter::Reading& loop, const StreamingTraffic& traffic,
                         const std::string& version);

}  // namespace osteomill
