#include "analysis/report/removal_metrics.h"

#include <algorithm>
#include <array>
#include <map>

namespace osteomill {

std::string tissue_name(const SessionInfo& session, std::uint8_t label) {
    for (const Tissue& tissue : session.tissues)
        if (tissue.label == label) return tissue.name;
    if (label != 0) return "tissue " + std::to_string(label);
    return std::ranges::find(session.tissues, "bone", &Tissue::name) == session.tissues.end() ? "bone"
                                                                                              : "other bone";
}

RemovalMetrics removal_metrics(const SessionTrace& trace, std::span<const Stroke> strokes) {
    std::array<std::int64_t, 256> left_out{};
    std::int64_t removed = 0;
    std::int64_t undone = 0;
    for (const TraceSample& sample : trace.samples)
        for (const TissueLevels& levels : sample.levels) {
            left_out[levels.tissue] += levels.milled - levels.restored;
            removed += levels.milled - levels.restored;
            undone += levels.restored;
        }
    RemovalMetrics metrics{.removed_mm3 = trace.mm3(removed), .undone_mm3 = trace.mm3(undone)};
    metrics.undos = static_cast<std::size_t>(std::ranges::count_if(trace.events, [](const ControlEvent& one) {
        return !one.is_refused && (one.action == SessionAction::undo || one.action == SessionAction::reset);
    }));
    std::array<bool, 256> is_named{};
    for (const Tissue& tissue : trace.session.tissues) {
        metrics.by_tissue.push_back({tissue.name, trace.mm3(left_out[tissue.label])});
        is_named[tissue.label] = true;
    }
    for (std::size_t label = 0; label < left_out.size(); ++label)
        if (!is_named[label] && left_out[label] != 0)
            metrics.by_tissue.push_back(
                {tissue_name(trace.session, static_cast<std::uint8_t>(label)), trace.mm3(left_out[label])});
    std::map<std::size_t, std::int64_t> by_burr;
    for (const Stroke& stroke : strokes)
        for (const Stroke::Slice& slice : stroke.slices)
            for (const auto& [burr, levels] : slice.levels_by_burr)
                by_burr[burr] += slice.is_undone ? 0 : levels;
    for (const auto& [burr, levels] : by_burr)
        metrics.by_burr.push_back({trace.session.burrs[burr].name, trace.mm3(levels)});
    return metrics;
}

}  // namespace osteomill
