#include "studies/stability/rails/motion_on_rails.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>

#include "simulation/coupling/couplings.h"
#include "simulation/force_models/milling_model.h"
#include "studies/force/bone_block.h"
#include "studies/force/random_motions.h"
#include "studies/stability/map/scene_plan.h"

namespace osteomill::study {
namespace {

constexpr double rail_voxel_mm = 0.1;
constexpr int ticks_to_get_there = 750;
constexpr int measured_ticks = 250;
constexpr double least_depth_mm = 0.12;
constexpr double most_tilt_deg = 60.0;
/// A slower hand is not there within the run-in: the spring gives way by some tenths of a millimetre first.
constexpr double least_feed_mm_per_s = 1.0;
/// A slow spindle at a fast feed would take more force than an arm has.
constexpr double most_force_n = 3.0;

}  // namespace

std::vector<SteadyCase> motions_on_rails(int count, std::uint64_t seed) {
    constexpr int drawn_for_each = 8;
    std::vector<SteadyCase> motions;
    for (const RandomMotion& drawn : random_motions(drawn_for_each * count, seed, rail_voxel_mm)) {
        if (static_cast<int>(motions.size()) == count) break;
        const SteadyCase& c = drawn.motion;
        if (drawn.dives || c.previous_groove_mm_higher || c.depth_mm < least_depth_mm ||
            drawn.tilt_deg > most_tilt_deg || glm::length(c.velocity_mm_per_s) < least_feed_mm_per_s)
            continue;
        if (glm::length(mean_reference_force_n(motion_of(c), bone_of(c))) > most_force_n) continue;
        motions.push_back(c);
    }
    return motions;
}

OnRails run_on_rails(const SteadyCase& c, const std::string& coupling_name, bool feed_forward) {
    const glm::dvec3 start_mm = (c.burr.radius_mm() - c.depth_mm) * c.up;
    const glm::dvec3 end_mm = start_mm + (ticks_to_get_there + measured_ticks) * tick_s * c.velocity_mm_per_s;
    // The burr yields: it lags, and is pushed out and aside by some tenths of a millimetre.
    const double margin_mm = c.burr.radius_mm() + 3.0;
    const BoneBlock block{.low_mm = glm::min(start_mm, end_mm) - margin_mm,
                          .high_mm = glm::max(start_mm, end_mm) + margin_mm,
                          .up = c.up};
    MillingModel model(voxelised(block, rail_voxel_mm), {c.burr}, {});
    const auto coupling =
        make_coupling(coupling_named(coupling_name), {.device = {}, .feed_forward = feed_forward});
    ForgottenChanges changes;
    const auto latest = std::make_unique<MillingResult>();
    const auto mill = [&](const ToolPose& pose, bool spindle_on, double now_s) {
        model.step({.pose = pose, .spindle_on = spindle_on, .elapsed_s = tick_s}, now_s, changes, *latest);
    };
    const ToolPose start{start_mm, c.spindle_axis};
    mill(start, false, -tick_s);
    mill(start, true, 0.0);

    OnRails run;
    std::uint64_t damped_before = 0;
    for (int tick = 0; tick < ticks_to_get_there + measured_ticks; ++tick) {
        const double now_s = tick * tick_s;
        const HandState hand{.now_s = now_s,
                             .tick_s = tick_s,
                             .pose = {start_mm + now_s * c.velocity_mm_per_s, c.spindle_axis},
                             .velocity_mm_per_s = c.velocity_mm_per_s,
                             .spindle_on = true};
        const CouplingOutput out = coupling->tick(hand, *latest);
        mill(out.burr_pose, true, now_s);
        if (tick < ticks_to_get_there) {
            damped_before = coupling->solve_counts().damped;
            continue;
        }
        run.hand_n += out.force_n / static_cast<double>(measured_ticks);
        run.model_n += latest->force_n / static_cast<double>(measured_ticks);
    }
    run.is_driven = coupling->solve_counts().damped > damped_before;
    return run;
}

}  // namespace osteomill::study
