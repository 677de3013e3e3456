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

}  // namespace

std::vector<DelayRow> delay_rows(bool quick, const std::function<void(double)>& report) {
    // As the server measures it, with the arm's own millisecond.
    const auto measured_s = [](double bridge_ms) { return 0.001 * (1.0 + bridge_ms); };
    std::vector<DelayRow> rows;
    SceneCache cache;
    const std::vector<double> ways_ms{0.0, 0.2, 0.5, 1.0, 2.0};
    const std::vector<MapCase> all = cases(quick);
    std::size_t done = 0;
    for (const double bridge_ms : ways_ms) {
        DelayRow row{.bridge_ms = bridge_ms,
                     .share = stiffest_spring({.delay_s = measured_s(bridge_ms)}).stiffness_n_per_mm /
                              ArmModel{}.max_stiffness_n_per_mm};
        for (const MapCase& c : all) {
            ++row.cases;
            if (is_stable(c, bridge_ms, 1.0, cache)) ++row.stable_with_all;
            if (is_stable(c, bridge_ms, row.share, cache)) ++row.stable_with_share;
            report(static_cast<double>(++done) / static_cast<double>(ways_ms.size() * all.size()));
        }
        rows.push_back(row);
    }
    return rows;
}

}  // namespace osteomill::study
