// The report of a session as HTML that opens anywhere without a network: no script, no other file. One page
// that stands alone, then an appendix.
#pragma once

#include <string>
#include <vector>

#include "analysis/report/reference_sessions.h"
#include "analysis/report/session_metrics.h"
#include "analysis/report/session_pictures.h"

namespace osteomill {

/// Names and notes are shown as text, whatever they hold.
std::string report_html(const SessionTrace& trace, const SessionMetrics& metrics,
                        const std::vector<MetricRow>& rows, const SessionPictures& pictures,
                        const ReferenceSessions& references);

}  // namespace osteomill
