#include "analysis/report/structure_metrics.h"

#include <algorithm>

namespace osteomill {

std::vector<StructureMetrics> structure_metrics(const SessionTrace& trace) {
    std::vector<StructureMetrics> all;
    const std::vector<Tissue>& tissues = trace.session.tissues;
    for (std::size_t tissue = 0; tissue < tissues.size(); ++tissue) {
        if (!tissues[tissue].is_protected) continue;
        StructureMetrics metrics{.name = tissues[tissue].name};
        const auto account = std::ranges::find(trace.structures, tissue,
                                               [](const StructureAccount& one) { return one.last.tissue; });
        if (account != trace.structures.end()) {
            const StructureDistance& last = account->last;
            if (account->nearest_mm) metrics.nearest_mm = std::max(0.0, *account->nearest_mm);
            metrics.touches = last.touches_so_far;
            if (metrics.touches > 0) metrics.first_touch_s = last.first_touch_s;
            metrics.touched_s = last.touched_s;
            metrics.dose_mm3 = last.removed_mm3;
            metrics.undone_dose_mm3 = account->given_back_mm3;
            metrics.entered_mm3 = last.entered_mm3;
        }
        all.push_back(std::move(metrics));
    }
    return all;
}

}  // namespace osteomill
