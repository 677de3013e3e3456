#include "studies/stability/map/map_run.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <span>
#include <vector>

#include "devices/simulated/hand_and_arm.h"
#include "simulation/coupling/couplings.h"
#include "simulation/force_models/milling_model.h"
#include "simulation/loop/milling_session.h"
#include "studies/force/bone_block.h"
#include "studies/stability/map/bench_device.h"
#include "studies/stability/map/scene_cache.h"
#include "studies/stability/map/stability_verdict.h"

namespace osteomill::study {

namespace {

/// A run, tick by tick from the release on; shorter than the plan where it went astray.
struct RunRecord {
    std::vector<glm::dvec3> tool_mm;
    std::vector<glm::dvec3> burr_mm;
    std::vector<glm::dvec3> force_n;
    std::vector<double> taken_mj;
    std::vector<double> removed_mm3;  ///< since the start
    SolveCounts solve{};
    std::uint64_t energy_faults = 0;
    bool is_astray = false;
};

/// How far from the truth the tool may be and not count as astray. On a soft wall a hand swings by
/// centimetres, and a method that damps the swing is not astray for it.
double most_off_the_truth_mm(const ScenePlan& plan, const std::vector<TruthTick>& truth) {
    if (plan.scene == MapScene::cutting) return astray_mm;
    const auto [lowest, highest] =
        std::minmax_element(truth.begin(), truth.end(),
                            [](const TruthTick& a, const TruthTick& b) { return a.tool_mm.z < b.tool_mm.z; });
    return astray_mm + highest->tool_mm.z - lowest->tool_mm.z;
}

Scene scene_of(const MapCase& c, const ScenePlan& plan) {
    Scene scene;
    scene.feed_forward = c.feed_forward;
    scene.burrs = {plan.burr};
    scene.start_pose.position_mm = guided_position_mm(plan, plan.timing.guided);
    return scene;
}

RunRecord run_session(const MapCase& c, const ScenePlan& plan, const Bone& bone,
                      const std::vector<TruthTick>& truth) {
    const std::size_t ticks = plan.timing.guided + plan.timing.released();
    BenchDevice device(c, plan);
    MillingSession session(scene_of(c, plan), bone, device,
                           {.clock = ClockKind::virtual_time,
                            .milling_rate_hz = c.milling_rate_hz,
                            .coupling = coupling_named(c.method),
                            .force_model = "milling",
                            .duration_s = tick_s * static_cast<double>(ticks)});
    RunRecord run;
    const double most_off_mm = most_off_the_truth_mm(plan, truth);
    std::atomic<bool> stop{false};
    device.on_tick([&](const std::vector<DeviceTick>& record) {
        session.exchange().tool.refresh();
        const ToolState& last = session.exchange().tool.front();
        if (!last.fault.empty()) run.is_astray = true;
        if (record.empty() || run.burr_mm.size() == record.size()) return;
        // The loop's result of the tick before.
        run.burr_mm.push_back(last.burr_position_mm);
        run.removed_mm3.push_back(last.removed_mm3);
        const glm::dvec3 off_mm = record.back().tool_mm - truth[record.size() - 1].tool_mm;
        if (!(glm::length(off_mm) < most_off_mm)) run.is_astray = true;
        if (run.is_astray || record.size() == truth.size()) stop.store(true);
    });
    session.run(stop);
    run.solve = session.solve_counts();
    run.energy_faults = session.fault_counts()[static_cast<std::size_t>(Fault::energy_to_hand)];

    const std::size_t complete = run.burr_mm.size();
    for (std::size_t i = 0; i < complete; ++i) {
        const DeviceTick& tick = device.record()[i];
        run.tool_mm.push_back(tick.tool_mm);
        run.force_n.push_back(tick.force_n);
        run.taken_mj.push_back(tick.taken_mj);
    }
    return run;
}

std::vector<glm::dvec3> forces_of(const std::vector<TruthTick>& truth) {
    std::vector<glm::dvec3> forces_n;
    for (const TruthTick& tick : truth) forces_n.push_back(tick.force_n);
    return forces_n;
}

/// By the trapezoid: a truth's force does not wait for the next tick.
std::vector<double> energy_taken_mj(const std::vector<TruthTick>& truth) {
    std::vector<double> taken_mj;
    double sum_mj = 0.0;
    for (std::size_t i = 0; i + 1 < truth.size(); ++i) {
        sum_mj -=
            0.5 * glm::dot(truth[i].force_n + truth[i + 1].force_n, truth[i + 1].tool_mm - truth[i].tool_mm);
        taken_mj.push_back(sum_mj);
    }
    return taken_mj;
}

void measure_whole_run(const RunRecord& run, MapOutcome& outcome) {
    for (std::size_t i = 0; i < run.force_n.size(); ++i) {
        outcome.peak_n = std::max(outcome.peak_n, glm::length(run.force_n[i]));
        if (i > 0)
            outcome.largest_jump_n =
                std::max(outcome.largest_jump_n, glm::distance(run.force_n[i], run.force_n[i - 1]));
    }
}

void measure_window(const RunRecord& run, const std::vector<TruthTick>& truth, const SceneTiming& timing,
                    MapOutcome& outcome) {
    // A run that went astray is measured up to that moment.
    const std::size_t end = std::min(timing.settling + timing.window, run.force_n.size());
    const std::size_t begin = std::min(timing.settling, end / 2);
    if (begin == end) return;
    glm::dvec3 sum_n(0.0);
    glm::dvec3 truth_sum_n(0.0);
    double squares = 0.0;
    double depth_squares = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
        const glm::dvec3 error_n = run.force_n[i] - truth[i].force_n;
        const double depth_mm = run.burr_mm[i].z - truth[i].burr_mm.z;
        squares += glm::dot(error_n, error_n);
        depth_squares += depth_mm * depth_mm;
        sum_n += run.force_n[i];
        truth_sum_n += truth[i].force_n;
    }
    const auto count = static_cast<double>(end - begin);
    outcome.truth_mean_n = glm::length(truth_sum_n) / count;
    outcome.rms_error_n = std::sqrt(squares / count);
    outcome.mean_error_n = glm::distance(sum_n, truth_sum_n) / count;
    outcome.depth_error_mm = std::sqrt(depth_squares / count);
    // A tick's is that at its end.
    outcome.removed_mm3 = run.removed_mm3[end - 1] - (begin > 0 ? run.removed_mm3[begin - 1] : 0.0);
}

}  // namespace

MapOutcome run_map_case(const MapCase& c, SceneCache& cache) {
    const ScenePlan plan = plan_of(c);
    const std::vector<TruthTick>& truth = cache.truth(c);
    const RunRecord run = run_session(c, plan, cache.bone(c, plan), truth);

    MapOutcome outcome;
    if (plan.scene == MapScene::cutting) {
        constexpr double mm_per_m = 1000.0;
        outcome.resistance_n_s_per_m = mm_per_m * glm::length(plan.steady_force_n) / plan.feed_mm_per_s;
    }
    measure_whole_run(run, outcome);
    measure_window(run, truth, plan.timing, outcome);

    const std::vector<glm::dvec3> truth_force_n = forces_of(truth);
    const std::vector<double> truth_taken_mj = energy_taken_mj(truth);
    const Verdict verdict = verdict_on({.force_n = run.force_n,
                                        .taken_mj = run.taken_mj,
                                        .truth_force_n = truth_force_n,
                                        .truth_taken_mj = truth_taken_mj,
                                        .window_begins = plan.timing.settling,
                                        .window_ends = plan.timing.settling + plan.timing.window,
                                        .spring_n_per_mm = rendered_spring_n_per_mm(plan),
                                        .encoder_step_mm = c.is_ideal_device ? 0.0 : ArmModel{}.resolution_mm,
                                        .is_astray = run.is_astray});
    outcome.is_stable = verdict.is_stable;
    outcome.limit_cycle_n = verdict.limit_cycle_n;
    outcome.injected_mj = verdict.injected_mj;
    outcome.max_residual_n = run.solve.max_residual_n;
    outcome.fallbacks = static_cast<double>(run.solve.fallbacks);
    outcome.energy_faults = static_cast<double>(run.energy_faults);
    return outcome;
}

MapOutcome run_map_case(const MapCase& c) {
    SceneCache cache;
    return run_map_case(c, cache);
}

std::vector<double> coupling_tick_us(const std::string& method, int ticks) {
    constexpr double tick_s = 0.001;
    constexpr double feed_mm_per_s = 6.0;
    constexpr double depth_mm = 1.0;
    const Burr burr;
    const double travel_mm = feed_mm_per_s * tick_s * ticks;
    MillingModel model(voxelised({.low_mm = {-4.0, -4.0, -3.0}, .high_mm = {travel_mm + 4.0, 4.0, 0.0}}, 0.1),
                       {burr}, {});
    const auto coupling = make_coupling(
        coupling_named(method),
        {.device = in_patient_space(limits_of(ArmModel{}), ArmScale(1.0)), .milling_period_s = tick_s});
    ForgottenChanges changes;
    const auto result = std::make_unique<MillingResult>();  // too large for a stack
    std::vector<double> us;
    for (int i = 0; i < ticks; ++i) {
        const double now_s = i * tick_s;
        const HandState hand{
            .now_s = now_s,
            .tick_s = tick_s,
            .pose = {{feed_mm_per_s * now_s, 0.017, burr.radius_mm() - depth_mm}, {0.0, 0.0, 1.0}},
            .velocity_mm_per_s = {feed_mm_per_s, 0.0, 0.0},
            .spindle_on = true};
        const auto before = std::chrono::steady_clock::now();
        const CouplingOutput output = coupling->tick(hand, *result);
        const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - before;
        us.push_back(taken.count());
        model.step(
            {.pose = output.burr_pose, .spindle_on = true, .elapsed_s = tick_s, .wants_engagement = true},
            now_s, changes, *result);
    }
    return us;
}

}  // namespace osteomill::study
