// All metrics of a session, and the same as a table of names, values and units. Definitions: docs/metrics.md.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/report/cutting_metrics.h"
#include "analysis/report/motion_metrics.h"
#include "analysis/report/plan_metrics.h"
#include "analysis/report/plunge_watch.h"
#include "analysis/report/rating_result.h"
#include "analysis/report/structure_metrics.h"
#include "common/scene/rating.h"

namespace osteomill {

struct SessionMetrics {
    MotionMetrics motion;
    StrokeMetrics strokes;
    RemovalMetrics removal;
    ForceMetrics force;
    PlungeMetrics plunges;
    std::vector<StructureMetrics> structures;
    NearnessMetrics near;
    std::vector<ExposureMetrics> exposures;
    std::optional<PlanMetrics> plan;
    PassMarks pass;       ///< empty if the recording is incomplete: half a session reaches no mark
    RatingResult rating;  ///< empty if the recording is incomplete
};

SessionMetrics session_metrics(const SessionTrace& trace);

/// One number of a session.
struct MetricRow {
    std::string group;  ///< heading: "Time and motion"
    std::string key;    ///< "force_mean_n", as in docs/metrics.md
    std::string of;     ///< which tissue, burr or structure; empty: the session
    std::string text;   ///< for people: "mean force"
    std::optional<double> value;
    std::string unit;  ///< "mm^3"; empty: a count or a ratio
};

std::vector<MetricRow> metric_rows(const SessionMetrics& metrics);

/// The sum of the metric with this key over tissues, burrs or structures; nothing if none has a value.
std::optional<double> sum_of(std::span<const MetricRow> rows, std::string_view key);

/// Verdict on a session: its metrics against the pass marks of its scene.
struct JudgedMark {
    const PassMarkKind* kind = nullptr;
    double mark = 0.0;
    std::optional<double> value{};  ///< of the metric, added up over structures; nothing: not measured

    /// A metric that was not measured reaches no mark.
    bool is_reached() const { return value && (kind->is_least ? *value >= mark : *value <= mark); }
};

/// In the order of pass_mark_kinds.
std::vector<JudgedMark> judged_marks(const PassMarks& marks, std::span<const MetricRow> rows);

/// Nothing if there are no marks.
std::optional<bool> has_passed(std::span<const JudgedMark> marks);

}  // namespace osteomill
