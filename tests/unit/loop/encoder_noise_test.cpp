// The effect of an arm's encoder steps on the force that its hand feels: the tooth scene, milled on the
// virtual clock.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <variant>

#include "devices/simulated/simulated_device.h"
#include "imaging/bone_from_hu.h"
#include "imaging/phantoms/phantom.h"
#include "simulation/loop/milling_session.h"

namespace osteomill::encoder_noise_test {
namespace {

/// A simulated arm in a firm hand; keeps what the written forces do.
class NotingArm final : public HapticDevice {
  public:
    NotingArm(const Scene& scene, const ArmModel& arm)
        : arm_(make_trajectory(scene.trajectory, scene.start_pose, scene.burrs, scene.start_burr),
               scene.device, arm, hand_model(Grip::firm)) {}

    std::string name() const override { return arm_.name(); }
    DeviceLimits limits() const override { return arm_.limits(); }
    void start() override {}
    DeviceState read(double now_s) noexcept override { return arm_.read(now_s); }
    void write(const glm::dvec3& force_n) noexcept override {
        constexpr double felt_jump_n = 0.03;
        constexpr double least_force_n = 0.005;
        constexpr double slowest_noise_hz = 5.0;
        const double jump_n = glm::distance(force_n, last_n_);
        largest_jump_n = std::max(largest_jump_n, jump_n);
        jumps_ += jump_n > felt_jump_n ? 1.0 : 0.0;
        last_n_ = force_n;
        slow_n_ += 2.0 * std::numbers::pi * slowest_noise_hz * MillingSession::tick_s * (force_n - slow_n_);
        if (glm::length(force_n) >= least_force_n) {
            ++felt_ticks_;
            force_sum_n_ += glm::length(force_n);
            fast_squares_n2_ += glm::dot(force_n - slow_n_, force_n - slow_n_);
        }
        arm_.write(force_n);
    }
    void stop() noexcept override {}

    bool is_finished() const { return arm_.is_finished(); }
    /// The mean over ticks with a force.
    double mean_force_n() const { return force_sum_n_ / felt_ticks_; }
    double noise_n() const { return std::sqrt(fast_squares_n2_ / felt_ticks_); }
    double jumps_per_s() const { return jumps_ / (felt_ticks_ * MillingSession::tick_s); }

    double largest_jump_n = 0.0;  ///< between two ticks

  private:
    SimulatedDevice arm_;
    glm::dvec3 last_n_{0.0}, slow_n_{0.0};
    double jumps_ = 0.0, felt_ticks_ = 0.0, force_sum_n_ = 0.0, fast_squares_n2_ = 0.0;
};

/// The lesion of the tooth drilled out with `implicit`.
void drill_tooth(NotingArm& arm, const Scene& scene) {
    MillingSession session(
        scene,
        bone_from_hu(std::get<HuSlices>(make_phantom("tooth")), phantom_threshold_hu, stiffness_of(scene)),
        arm, {.clock = ClockKind::virtual_time, .coupling = {CouplingKind::implicit}});
    std::atomic<bool> is_over{false};
    session.run(is_over, [&](const ToolState&) {
        if (arm.is_finished()) is_over.store(true);
    });
}

// The bar of a knock is 0.03 N; docs/results/stability.md has its remainder at the arm's 0.055 mm.
TEST(EncoderNoise, OfTheSimulatedArmIsNotFeltAsTaps) {
    const Scene scene = phantom_scene("tooth");
    NotingArm shipped(scene, ArmModel{});
    drill_tooth(shipped, scene);
    EXPECT_GT(shipped.mean_force_n(), 0.03);
    EXPECT_LT(shipped.jumps_per_s(), 2.0) << "21 when each step was made up for at once";
    EXPECT_LT(shipped.largest_jump_n, 0.1);
    NotingArm fine(scene, {.resolution_mm = 0.003});
    drill_tooth(fine, scene);
    EXPECT_LT(fine.jumps_per_s(), 0.5) << "what the cut itself does";
    NotingArm exact(scene, {.resolution_mm = 0.0});
    drill_tooth(exact, scene);
    EXPECT_LT(fine.noise_n(), 1.3 * exact.noise_n());
}

}  // namespace
}  // namespace osteomill::encoder_noise_test
