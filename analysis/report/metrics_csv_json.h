// The metrics of a session as CSV and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/report/rating_result.h"
#include "analysis/report/session_metrics.h"
#include "analysis/report/session_trace.h"

namespace osteomill {

/// A line a metric: metric,of,value,unit. The value is empty if there is nothing to measure.
std::string metrics_csv(const std::vector<MetricRow>& rows);

/// Keys: session {trainee, case, scene, began, version, protocol, bone_checksum, settings}, metrics {key:
/// value, or, if there is one for each tissue, burr or structure, KEY_of: {name: value}}, rating
/// (rating_json; only if there is one), events, is_complete (the recording has the session's end), error
/// (null: it could be read to its end). Bytes that are no UTF-8 are replaced.
std::string metrics_json(const SessionTrace& trace, const std::vector<MetricRow>& rows,
                         const RatingResult& rating = {});

/// Keys: points, most_points, undos, undone_mm3, items [{name, points, most_points, is_reached (null: not
/// decided), when, source, values {what is asked for: value}, why_not (null: the condition can be read)}].
nlohmann::ordered_json rating_json(const RatingResult& rating);

/// "2026-11-23 21:40 UTC"; empty if the recording holds no time.
std::string began_text(std::int64_t unix_ns);

}  // namespace osteomill
