#include "studies/stability/map/map_view.h"

#include <algorithm>

namespace osteomill::study {

namespace {

double share_of_truth(double error_n, const MapOutcome& outcome) {
    return outcome.truth_mean_n > 0.0 ? error_n / outcome.truth_mean_n : no_share;
}

}  // namespace

std::vector<MapResult> results_where(const WholeMap& map,
                                     const std::function<bool(const MapPoint&)>& is_wanted) {
    std::vector<MapResult> found;
    for (std::size_t i = 0; i < map.points.size(); ++i)
        if (is_wanted(map.points[i])) found.push_back({map.points[i], map.outcomes[i]});
    return found;
}

double stable_share(const std::vector<MapResult>& results) {
    if (results.empty()) return no_share;
    const auto stable = std::count_if(results.begin(), results.end(),
                                      [](const MapResult& result) { return result.outcome.is_stable; });
    return static_cast<double>(stable) / static_cast<double>(results.size());
}

double rms_error(const MapOutcome& outcome) {
    return share_of_truth(outcome.rms_error_n, outcome);
}

double mean_error(const MapOutcome& outcome) {
    return share_of_truth(outcome.mean_error_n, outcome);
}

}  // namespace osteomill::study
