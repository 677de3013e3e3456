// Range in which the default coupling holds with an arm behind the bridge, by what the way takes: with all of
// the arm's own stiffness, and with what the server chooses for the delay.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace osteomill::study {

struct DelayRow {
    double bridge_ms = 0.0;  ///< there and back, with a jitter of a quarter
    double share = 1.0;      ///< of the arm's stiffness that the server takes
    int cases = 0;
    int stable_with_all = 0;
    int stable_with_share = 0;
};

/// 0, 0.2, 0.5, 1 and 2 ms; cutting conditions of the stability map and a wall, with each grip; `quick`:
/// fewer. `report` is told how much is done, 0 to 1.
std::vector<DelayRow> delay_rows(bool quick, const std::function<void(double)>& report);

}  // namespace osteomill::study
