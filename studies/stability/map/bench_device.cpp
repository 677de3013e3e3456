#include "studies/stability/map/bench_device.h"

#include <glm/geometric.hpp>

#include "devices/simulated/hand_and_arm.h"

namespace osteomill::study {

BenchDevice::BenchDevice(const MapCase& c, const ScenePlan& plan)
    : plan_(plan),
      resolution_mm_(c.is_ideal_device ? 0.0 : ArmModel{}.resolution_mm),
      max_force_n_(ArmModel{}.max_force_n),
      sensor_(resolution_mm_),
      in_delay_n_(static_cast<std::size_t>(c.delay_ticks), glm::dvec3(0.0)),
      guided_left_(plan.timing.guided),
      motion_{guided_position_mm(plan, guided_left_), glm::dvec3(0.0)} {
    record_.reserve(plan.timing.released());
}

DeviceLimits BenchDevice::limits() const {
    DeviceLimits limits = limits_of(ArmModel{});
    limits.position_resolution_mm = resolution_mm_;
    if (plan_.scene == MapScene::wall) limits.max_stiffness_n_per_mm = plan_.wall_n_per_mm;
    return limits;
}

void BenchDevice::move_to_next_tick() {
    if (guided_left_ > 0) {
        --guided_left_;
        motion_ = guided_left_ == 0 ? plan_.at_release
                                    : ToolMotion{guided_position_mm(plan_, guided_left_), glm::dvec3(0.0)};
        return;
    }
    DeviceTick& tick = record_.back();
    const double began_s = tick_s * static_cast<double>(record_.size() - 1);
    constexpr double substep_s = tick_s / substeps;
    const glm::dvec3 moving_n = plan_.is_on_rail ? glm::dvec3(0.0, 0.0, motor_force_n_.z) : motor_force_n_;
    for (int i = 0; i < substeps; ++i)
        motion_ = fine_step(plan_.tool, plan_.intent, motion_, began_s + i * substep_s, moving_n, substep_s);
    // The ledger counts along one axis: along the force, which is held.
    const double force_n = glm::length(motor_force_n_);
    if (force_n > 0.0)
        ledger_.held(force_n, glm::dot(motor_force_n_, motion_.position_mm - tick.tool_mm) / force_n);
    tick.taken_mj = ledger_.taken_j();
}

DeviceState BenchDevice::read(double now_s) noexcept {
    if (has_begun_) move_to_next_tick();
    if (observer_) observer_(record_);
    sensor_.read(motion_.position_mm, has_begun_ ? tick_s : 0.0);
    const PedalStatement pedal{.is_down = has_begun_ && plan_.scene == MapScene::cutting, .said_s = now_s};
    has_begun_ = true;
    return {.position_mm = sensor_.position_mm(),
            .velocity_mm_per_s = sensor_.velocity_mm_per_s(),
            .pedal = pedal};
}

void BenchDevice::write(const glm::dvec3& force_n) noexcept {
    in_delay_n_.push_back(force_n);
    motor_force_n_ = in_delay_n_.front();
    in_delay_n_.pop_front();
    const double size_n = glm::length(motor_force_n_);
    if (size_n > max_force_n_) motor_force_n_ *= max_force_n_ / size_n;
    if (guided_left_ == 0) record_.push_back({.tool_mm = motion_.position_mm, .force_n = motor_force_n_});
}

}  // namespace osteomill::study
