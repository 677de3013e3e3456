// The report of a session as one HTML page that opens anywhere without a network: no script, no other file.
#pragma once

#include <string>
#include <vector>

#include "analysis/report/session_metrics.h"
#include "analysis/report/session_pictures.h"
#include "analysis/report/session_trace.h"

namespace osteomill {

/// Names and notes are shown as text, whatever they hold.
std::string report_html(const SessionTrace& trace, const SessionMetrics& metrics,
                        const std::vector<MetricRow>& rows, const SessionPictures& pictures);

/// What all pages of the project look like: the style sheet, for a <style> element.
extern const char* const page_style;

/// A number as a person reads it: at most four digits that count.
std::string number_text(double value);

}  // namespace osteomill
