// Verdict on a session: its metrics against the pass marks of its scene.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/report/session_metrics.h"
#include "common/scene/rating.h"

namespace osteomill {

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
