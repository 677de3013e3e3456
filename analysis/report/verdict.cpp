#include "analysis/report/verdict.h"

#include <algorithm>

namespace osteomill {

std::vector<JudgedMark> judged_marks(const PassMarks& marks, std::span<const MetricRow> rows) {
    std::vector<JudgedMark> judged;
    for (const PassMarkKind& kind : pass_mark_kinds)
        if (const auto mark = marks.find(kind.metric); mark != marks.end())
            judged.push_back({&kind, mark->second, sum_of(rows, kind.metric)});
    return judged;
}

std::optional<bool> has_passed(std::span<const JudgedMark> marks) {
    if (marks.empty()) return std::nullopt;
    return std::ranges::all_of(marks, &JudgedMark::is_reached);
}

}  // namespace osteomill
