// An arm in a hand, in three dimensions and fine substeps, all of whose figures are known: what a measurement
// of it should find. Each axis is a held_body.h; SI units within, mm and N at the device's side.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "simulation/device/haptic_device.h"
#include "tests/support/bench/fine_motion.h"

namespace osteomill::testing {

struct FineFigures {
    HeldBody arm{.mass_kg = 0.045, .damping_n_s_per_m = 0.3};  ///< alone
    double hand_kg = 0.1;
    double hand_damping_n_s_per_m = 2.0;
    double hand_stiffness_n_per_m = 100.0;
    double step_mm = 0.0;   ///< of a reading; 0: exact
    double noise_mm = 0.0;  ///< rms of a reading, before it is rounded
    double delay_ticks = 0.0;
    double tremor_mm = 0.0;  ///< amplitude of where the hand means to be
    double tremor_hz = 9.0;

    /// Arm and hand as one.
    HeldBody held() const {
        return {.mass_kg = arm.mass_kg + hand_kg,
                .damping_n_s_per_m = arm.damping_n_s_per_m + hand_damping_n_s_per_m,
                .hand_stiffness_n_per_m = hand_stiffness_n_per_m,
                .coulomb_friction_n = arm.coulomb_friction_n};
    }
};

/// Read and written a thousand times a second, by turns.
class FineArm final : public HapticDevice {
  public:
    static constexpr int substeps = 25;
    static constexpr double tick_s = 1e-3;

    FineArm(const FineFigures& figures, unsigned seed) : figures_(figures), random_(seed) {
        std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi);
        for (int k = 0; k < 3; ++k) {
            phase_[k] = angle(random_);
            home_mm_[k] = angle(random_);
        }
        written_n_.reserve(200'000);
    }

    // Changed by a test on the way.
    bool pedal = true;
    bool is_held = true;  ///< false: the hand has let go of it
    bool is_there = true;
    glm::dvec3 push_n{0.0};  ///< of the hand, beside its spring

    std::string name() const override { return "fine arm"; }
    DeviceLimits limits() const override {
        return {.apparent_mass_kg = figures_.arm.mass_kg, .position_resolution_mm = figures_.step_mm};
    }
    void start() override {}
    void stop() noexcept override {}

    DeviceState read(double now_s) noexcept override {
        DeviceState state;
        for (int k = 0; k < 3; ++k) {
            const double x_mm =
                home_mm_[k] + 1e3 * motion_[k].position_m + figures_.noise_mm * normal_(random_);
            state.position_mm[k] =
                figures_.step_mm > 0.0 ? figures_.step_mm * std::round(x_mm / figures_.step_mm) : x_mm;
        }
        // Up for the first ticks, as a pedal is before somebody presses it.
        state.pedal = {.is_down = pedal && written_n_.size() > 5, .said_s = now_s};
        state.connected = is_there;
        return state;
    }

    void write(const glm::dvec3& force_n) noexcept override {
        written_n_.push_back(force_n);
        const double tick = static_cast<double>(written_n_.size() - 1);
        const HeldBody body = is_held ? figures_.held() : figures_.arm;
        const double w = 2.0 * std::numbers::pi * figures_.tremor_hz;
        for (int i = 0; i < substeps; ++i) {
            const double at = tick + static_cast<double>(i) / substeps;
            const double said = std::floor(at - figures_.delay_ticks + 1e-9);
            const glm::dvec3 motors_n =
                said >= 0.0 ? written_n_[static_cast<std::size_t>(said)] : glm::dvec3(0.0);
            for (int k = 0; k < 3; ++k) {
                double hand_n = is_held ? push_n[k] : 0.0;
                if (is_held && figures_.tremor_mm > 0.0) {
                    const double angle = w * tick_s * at + phase_[k];
                    hand_n += 1e-3 * figures_.tremor_mm *
                              (figures_.hand_stiffness_n_per_m * std::sin(angle) +
                               figures_.hand_damping_n_s_per_m * w * std::cos(angle));
                }
                motion_[k] = fine_step(body, motion_[k], motors_n[k] + hand_n, tick_s / substeps);
            }
        }
    }

    const glm::dvec3& last_written_n() const { return written_n_.back(); }
    const std::vector<glm::dvec3>& written_n() const { return written_n_; }
    double position_mm(int axis) const { return 1e3 * motion_[axis].position_m; }

  private:
    FineFigures figures_;
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    MotionState motion_[3];
    double phase_[3];
    double home_mm_[3];
    std::vector<glm::dvec3> written_n_;
};

/// A random arm in a random hand: 30 to 300 g, light and firm grips and what lies about them, with and
/// without friction, steps, noise and tremor, up to three ticks late.
inline FineFigures random_arm(std::mt19937& random) {
    const auto even = [&random](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const auto by_ratio = [&even](double low, double high) {
        return low * std::pow(high / low, even(0.0, 1.0));
    };
    const bool is_firm = even(0.0, 1.0) < 0.5;
    FineFigures figures;
    figures.arm = {.mass_kg = by_ratio(0.03, 0.3), .damping_n_s_per_m = by_ratio(0.1, 0.6)};
    figures.arm.coulomb_friction_n = even(0.0, 1.0) < 0.25 ? 0.0 : even(0.0, 0.35);
    figures.hand_kg = (is_firm ? 0.5 : 0.1) * by_ratio(0.6, 1.6);
    figures.hand_stiffness_n_per_m = (is_firm ? 300.0 : 100.0) * by_ratio(0.6, 1.6);
    figures.hand_damping_n_s_per_m = (is_firm ? 5.0 : 2.0) * by_ratio(0.6, 1.6);
    figures.step_mm = even(0.0, 1.0) < 0.2 ? 0.0 : by_ratio(0.01, 0.1);
    figures.noise_mm = even(0.0, 1.0) < 0.5 ? 0.0 : by_ratio(0.0005, 0.01);
    figures.delay_ticks = even(0.0, 3.0);
    figures.tremor_mm = even(0.0, 1.0) < 0.3 ? 0.0 : even(0.0, 0.2);
    figures.tremor_hz = even(7.0, 12.0);
    return figures;
}

}  // namespace osteomill::testing
