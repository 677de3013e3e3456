// The first page of a report, which stands alone on paper: whose session, the verdict (session_metrics.h), a
// line for each protected structure that was milled ("Opened: ...") or only entered (structure_metrics.h),
// six numbers, two pictures, space for comment and signature.
#pragma once

#include <string>
#include <vector>

#include "analysis/report/reference_sessions.h"
#include "analysis/report/session_metrics.h"
#include "analysis/report/session_pictures.h"

namespace osteomill {

std::string first_page(const SessionTrace& trace, const SessionMetrics& metrics,
                       const std::vector<MetricRow>& rows, const SessionPictures& pictures,
                       const ReferenceSessions& references);

}  // namespace osteomill
