#include "analysis/report/plunge_metrics.h"

#include <algorithm>

namespace osteomill {

PlungeMetrics plunge_metrics(std::span<const Breakthrough> breakthroughs) {
    PlungeMetrics metrics{.breakthroughs = breakthroughs.size()};
    if (breakthroughs.empty()) return metrics;
    double sum_mm = 0.0;
    for (const Breakthrough& one : breakthroughs) sum_mm += one.plunge_mm;
    metrics.mean_mm = sum_mm / static_cast<double>(breakthroughs.size());
    metrics.most_mm = std::ranges::max(breakthroughs, {}, &Breakthrough::plunge_mm).plunge_mm;
    return metrics;
}

}  // namespace osteomill
