#include "studies/bridge/delay_rows.h"

#include "devices/simulated/arm_model.h"
#include "simulation/device/arm_spring.h"
#include "studies/stability/map/map_points.h"
#include "studies/stability/scene/map_run.h"

namespace osteomill::study {

namespace {

std::vector<MapCase> cases(bool quick) {
    std::vector<MapCase> found;
    for (const MapGrip grip : map_grips()) {
        for (const CuttingCondition& condition : cutting_conditions(quick))
            found.push_back({.method = "implicit",
                             .grip = grip,
                             .spindle_rpm = condition.spindle_rpm,
                             .depth_mm = condition.depth_mm,
                             .relative_stiffness = condition.relative_stiffness});
        found.push_back({.method = "implicit", .scene = MapScene::wall, .grip = grip});
    }
    return found;
}

bool is_stable(MapCase c, double bridge_ms, double share, SceneCache& cache) {
    c.bridge_ms = bridge_ms;
    c.stiffness_share = c.scene == MapScene::wall ? 1.0 : share;
    c.wall_n_per_mm = share * ArmModel{}.max_stiffness_n_per_mm;
    return run_map_case(c, cache).is_stable;
}

double share_taken(double bridge_ms) {
    // As the server measures it, with the arm's own millisecond.
    const double measured_s = 0.001 * (1.0 + bridge_ms);
    return stiffest_spring({.delay_s = measured_s}).stiffness_n_per_mm / ArmModel{}.max_stiffness_n_per_mm;
}

}  // namespace

std::vector<DelayCase> delay_cases(bool quick) {
    std::vector<DelayCase> found;
    for (const double bridge_ms : {0.0, 0.2, 0.5, 1.0, 2.0})
        for (const MapCase& c : cases(quick)) found.push_back({bridge_ms, c});
    return found;
}

DelayOutcome run(const DelayCase& c, SceneCache& cache) {
    return {is_stable(c.run, c.bridge_ms, 1.0, cache),
            is_stable(c.run, c.bridge_ms, share_taken(c.bridge_ms), cache)};
}

std::vector<DelayRow> delay_rows(const std::vector<DelayCase>& cases,
                                 const std::vector<DelayOutcome>& outcomes) {
    std::vector<DelayRow> rows;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double bridge_ms = cases[i].bridge_ms;
        if (rows.empty() || rows.back().bridge_ms != bridge_ms)
            rows.push_back({.bridge_ms = bridge_ms, .share = share_taken(bridge_ms)});
        ++rows.back().cases;
        rows.back().stable_with_all += outcomes[i].with_all ? 1 : 0;
        rows.back().stable_with_share += outcomes[i].with_share ? 1 : 0;
    }
    return rows;
}

}  // namespace osteomill::study
