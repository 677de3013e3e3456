// The metrics of a session as tables of HTML, group by group.
#pragma once

#include <string>
#include <vector>

#include "analysis/report/session_metrics.h"
#include "common/wire/session_info.h"

namespace osteomill {

/// Metrics of the session in two columns; below them the metrics that exist for each tissue, burr or
/// structure, a line each.
std::string metric_tables(const std::vector<MetricRow>& rows, const SessionInfo& session);

/// A patch in a tissue's colour.
std::string swatch(const Tissue& tissue);

}  // namespace osteomill
