#include "studies/stability/map/timed_coupling.h"

#include <chrono>
#include <memory>

#include "devices/simulated/hand_and_arm.h"
#include "simulation/coupling/couplings.h"
#include "simulation/force_models/milling_model.h"
#include "studies/force/bone_block.h"

namespace osteomill::study {

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
