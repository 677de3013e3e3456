#include "haptic_server/measuring/arm_measurement.h"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>

#include "haptic_server/measuring/arm_estimates.h"
#include "haptic_server/measuring/arm_shake.h"
#include "haptic_server/measuring/stiffness_ramp.h"
#include "simulation/device/measured_arm.h"
#include "simulation/loop/clock.h"
#include "simulation/loop/real_time.h"

namespace osteomill {

namespace {

/// Ticks a device once a millisecond, on the real clock or as fast as it can.
class Ticking {
  public:
    Ticking(HapticDevice& device, const MeasuringContext& context) : device_(device), context_(context) {}
    ~Ticking() { device_.write(glm::dvec3(0.0)); }
    Ticking(const Ticking&) = delete;
    Ticking& operator=(const Ticking&) = delete;

    /// `tick(state, now_s)` gives the force; until `is_over()`, or a stop. Notices of the device are passed
    /// on.
    template <typename Tick, typename IsOver>
    void run(Tick&& tick, IsOver&& is_over) {
        while (!is_over() && !context_.stop.load(std::memory_order_relaxed)) {
            if (!context_.is_virtual) wait();
            const double now_s = measuring_tick_s * static_cast<double>(next_++);
            device_.write(tick(device_.read(now_s), now_s));
            if (const char* const notice = device_.notice(); notice != notice_) {
                if (*notice != 0) context_.say(notice);
                notice_ = notice;
            }
        }
    }

  private:
    void wait() noexcept {
        clock_.sleep_until(measuring_tick_s * static_cast<double>(next_));
        const double late_s = clock_.now_s() - measuring_tick_s * static_cast<double>(next_);
        next_ += static_cast<long>(late_s / measuring_tick_s);  // missed ticks are not made up for
    }

    HapticDevice& device_;
    const MeasuringContext& context_;
    RealClock clock_;
    long next_ = 0;
    const char* notice_ = nullptr;  // the last that was said, of static lifetime
};

void estimate(const ArmShake& shake, ArmMeasurement& found) {
    found.arm.noise_mm = reading_noise_mm(shake.rest());
    found.arm.step_mm = encoder_step_mm(shake.all());
    for (std::size_t k = 0; k < 3; ++k) {
        const std::optional<PushedMotion> axis = pushed_motion(shake.push(k), k, found.arm.step_mm);
        found.axes[k] = axis;
        if (!axis) {
            found.not_measured.push_back(
                fmt::format("mass, friction and delay along {}: the arm hardly moved when it was pushed, or "
                            "not as it was pushed",
                            "xyz"[k]));
            continue;
        }
        const auto least = [](std::optional<double>& of_all, double value) {
            of_all = of_all ? std::min(*of_all, value) : value;
        };
        least(found.arm.moving_mass_kg, axis->mass_kg);
        least(found.arm.friction_n, axis->friction_n);
        found.arm.delay_s = std::max(found.arm.delay_s.value_or(0.0), measuring_tick_s * axis->delay_ticks);
    }
    if (found.arm.step_mm == 0.0)
        found.not_measured.push_back(
            "encoder step: readings go over into each other; if there are steps, noise hides them");
}

/// A thread inherits the priority of the loop that starts it, and is to leave it the processor.
void be_ordinary() noexcept {
    const sched_param none{};
    pthread_setschedparam(pthread_self(), SCHED_OTHER, &none);
}

void say_what_to_do(const MeasuringContext& context) {
    context.say(
        "hold the arm as loosely as you ever will, in the middle of its reach and in the air; press the "
        "pedal and hold both still until the end, about 20 s");
}

}  // namespace

ArmMeasurement measure_arm(HapticDevice& device, const MeasuringContext& context) {
    ArmMeasurement found;
    const DeviceLimits stated = device.limits();
    ArmShake shake(stated.max_force_n);
    device.start();
    {
        Ticking ticking(device, context);
        if (!context.is_virtual) (void)ask_for_real_time(haptic_priority);
        say_what_to_do(context);
        ticking.run([&](const DeviceState& arm, double now_s) { return shake.tick(arm, now_s); },
                    [&] { return shake.has_begun(); });
        if (shake.has_begun()) context.say("measuring: rest, then a push to and fro along each axis");
        ticking.run([&](const DeviceState& arm, double now_s) { return shake.tick(arm, now_s); },
                    [&] { return shake.is_over(); });
        found.end = shake.end();
        if (found.end == MeasuringEnd::done) {
            found.end = MeasuringEnd::none;
            MeasuringGuard guard = shake.guard();
            std::future<void> estimated = std::async(std::launch::async, [&] {
                be_ordinary();
                estimate(shake, found);
            });
            if (!context.is_virtual)
                ticking.run(
                    [&](const DeviceState& arm, double now_s) {
                        guard.look(arm, now_s);
                        return glm::dvec3(0.0);
                    },
                    [&] { return estimated.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
            estimated.get();
            const ArmSpring hoped = hoped_spring(stated, context.delay_s, found.arm);
            found.arm.damping_n_s_per_mm = hoped.damping_n_s_per_mm;
            StiffnessRamp ramp(
                {.damping_n_s_per_mm = hoped.damping_n_s_per_mm,
                 .resolution_mm = std::max(stated.position_resolution_mm, found.arm.resolution_mm()),
                 .noise_mm = found.arm.noise_mm,
                 .moving_mass_kg = found.arm.moving_mass_kg.value_or(stated.apparent_mass_kg),
                 .friction_n = found.arm.friction_n.value_or(0.0),
                 .delay_ticks = found.arm.delay_s.value_or(context.delay_s) / measuring_tick_s,
                 .sway_mm = sway_mm(shake.rest())},
                guard.again());
            context.say("measuring: a spring that gets stiffer, with taps, until the arm swings on it");
            ticking.run([&](const DeviceState& arm, double now_s) { return ramp.tick(arm, now_s); },
                        [&] { return ramp.is_over(); });
            found.end = ramp.end();
            found.arm.calm_n_per_mm = ramp.calm_n_per_mm();
            found.swinging_n_per_mm = ramp.swinging_n_per_mm();
        }
    }
    device.stop();
    if (!found.has_spring()) found.not_measured.push_back("stiffest calm spring: " + why_no_spring(found));
    return found;
}

std::string why_no_spring(const ArmMeasurement& found) {
    if (found.swinging_n_per_mm > 0.0)
        return fmt::format("the arm swung on the softest one, {} N/mm", StiffnessRamp::softest_n_per_mm);
    return text_of(found.end);
}

std::string text_of(const ArmMeasurement& found, const std::string& name, const DeviceLimits& stated,
                    double delay_s) {
    std::string text = fmt::format("{}, in a hand\n", name);
    const auto add = [&text](const char* what, const std::string& value) {
        text += fmt::format("  {:<20} {}\n", what, value);
    };
    const MeasuredArm& arm = found.arm;
    const auto by_axis = [&found](double PushedMotion::*figure, double scale) {
        std::string values;
        for (const auto& axis : found.axes)
            values +=
                (values.empty() ? "" : ", ") + (axis ? fmt::format("{:.3g}", scale * (*axis).*figure) : "-");
        return values;
    };
    if (arm.step_mm > 0.0) add("encoder step", fmt::format("{:.4f} mm", arm.step_mm));
    add("noise", fmt::format("{:.4f} mm rms", arm.noise_mm));
    if (std::ranges::any_of(found.axes, [](const auto& axis) { return axis.has_value(); })) {
        add("delay", fmt::format("{:.1f} ticks (x, y, z: {})", *arm.delay_s / measuring_tick_s,
                                 by_axis(&PushedMotion::delay_ticks, 1.0)));
        add("moving mass",
            fmt::format("{:.0f} g with the hand on it (x, y, z: {})", 1000.0 * *arm.moving_mass_kg,
                        by_axis(&PushedMotion::mass_kg, 1000.0)));
        add("friction",
            fmt::format("{:.2f} N (x, y, z: {})", *arm.friction_n, by_axis(&PushedMotion::friction_n, 1.0)));
    }
    if (found.has_spring()) {
        add("stiffest calm spring",
            fmt::format(
                "{:.2f} N/mm beside {:.1f} N s/m; {}", arm.calm_n_per_mm, 1000.0 * arm.damping_n_s_per_mm,
                found.swinging_n_per_mm > 0.0 ? fmt::format("it swung on {:.2f}", found.swinging_n_per_mm)
                                              : "none stiffer was tried"));
        const DeviceLimits gets = with_measured_spring(stated, delay_s, arm);
        add("spring so far", fmt::format("{:.2f} N/mm beside {:.1f} N s/m: {}", stated.max_stiffness_n_per_mm,
                                         1000.0 * stated.damping_n_s_per_mm, stated.stiffness_is_limited_by));
        add("spring from now on",
            fmt::format("{:.2f} N/mm beside {:.1f} N s/m: {}", gets.max_stiffness_n_per_mm,
                        1000.0 * gets.damping_n_s_per_mm, gets.stiffness_is_limited_by));
    }
    for (const std::string& line : found.not_measured) text += fmt::format("  not measured: {}\n", line);
    return text;
}

}  // namespace osteomill
