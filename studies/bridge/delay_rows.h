// Range in which the default coupling holds with an arm behind the bridge, by what the way takes: with all of
// the arm's own stiffness, and with what the server chooses for the delay.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "studies/stability/map/map_case.h"
#include "studies/stability/scene/scene_cache.h"

namespace osteomill::study {

struct DelayRow {
    double bridge_ms = 0.0;  ///< there and back, with a jitter of a quarter
    double share = 1.0;      ///< of the arm's stiffness that the server takes
    int cases = 0;
    int stable_with_all = 0;
    int stable_with_share = 0;
};

/// A case with an arm behind the bridge.
struct DelayCase {
    double bridge_ms = 0.0;
    MapCase run;
};
/// 0, 0.2, 0.5, 1 and 2 ms; cutting conditions of the stability map and a wall, with each grip; `quick`:
/// fewer.
std::vector<DelayCase> delay_cases(bool quick);

/// Whether it is stable.
struct DelayOutcome {
    bool with_all = false;    ///< of the arm's stiffness
    bool with_share = false;  ///< that the server takes
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DelayOutcome, with_all, with_share)
DelayOutcome run(const DelayCase& c, SceneCache& cache);

/// A row for each way, of outcomes in the order of the cases.
std::vector<DelayRow> delay_rows(const std::vector<DelayCase>& cases, const std::vector<DelayOutcome>& outcomes);

}  // namespace osteomill::study
