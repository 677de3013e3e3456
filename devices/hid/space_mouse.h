// A 3D mouse as a device of the loops: it has a position, by integration, and no force of its own. Its puck
// moves the target of a simulated hand that holds a simulated arm, as a client's mouse does, so that the tool
// yields to bone; clients show the force on that hand.
//
//     d(target)/dt = fastest_mm_per_s |u| u,  u: deflection, a share of the full one     (fine about the
//     centre)
//
// If the thread that reads the mouse is silent for Permission::by_message_s, the mouse counts as lost: a
// button that was down must not stay down because a USB bus hangs.
//
// The left button is the pedal, the right one goes on to the next burr of the scene's set.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>

#include "common/scene/scene.h"
#include "devices/hid/hid_transport.h"
#include "devices/hid/hid_worker.h"
#include "devices/simulated/held_arm.h"
#include "simulation/device/haptic_device.h"
#include "simulation/device/permission.h"
#include "simulation/exchange/triple_buffer.h"

namespace osteomill {

// The reports of a 3Dconnexion SpaceMouse: the first byte is the report's number.
//
//   1   three int16 of translation; some models add the three of rotation
//   2   three int16 of rotation
//   3   buttons, one bit each
//
// Full deflection is about +-350. The puck's axes: x to the right, y toward the person, z down.

/// Shares of full deflection, -1 to 1, in device space: x to the right, y away from the person, z up.
struct SpaceMouseState {
    glm::dvec3 translation{0.0};
    glm::dvec3 rotation{0.0};  ///< about those axes
    std::uint32_t buttons = 0;

    /// Applies a report; false for a meaningless one, which changes nothing. Real-time safe.
    bool take(std::span<const std::uint8_t> report) noexcept;
};

/// By vendor: Logitech's number with a product from 0xC603 to 0xC6FF, or 3Dconnexion's own; and by usage: a
/// multi-axis controller.
bool is_space_mouse(const HidDeviceInfo& device);

/// A reading that the mouse's thread hands to the haptic loop.
struct SpaceMouseReading {
    SpaceMouseState state;
    bool is_plugged = false;
    double said_s = 0.0;  ///< by the thread's clock: nothing more was waiting then
    std::uint64_t connection = 0;
};

class SpaceMouse final : public HapticDevice {
  public:
    static constexpr double fastest_mm_per_s = 40.0;
    static constexpr double fastest_rad_per_s = 0.8;
    /// The target goes no farther ahead of an arm that bone holds back: the hand would push no harder anyway.
    static constexpr double longest_lead_mm = 10.0;
    /// A puck that is deflected reports all the time: without a report it has been let go.
    static constexpr double longest_deflection_age_s = 0.2;

    /// The arm starts at rest at `start_pose` (patient LPS). The thread calls `clock_s`, seconds that never
    /// decrease, and `on_thread_start`; the transport outlives the mouse.
    SpaceMouse(const Scene& scene, const ArmModel& arm, const HandModel& hand, HidTransport& transport,
               std::function<double()> clock_s, std::function<void()> on_thread_start);

    std::string name() const override { return "3D mouse"; }
    DeviceLimits limits() const override { return limits_of(arm_); }
    void start() override { worker_.start(); }
    DeviceState read(double now_s) noexcept override;
    void write(const glm::dvec3& force_n) noexcept override { held_arm_.set_motor_force(force_n); }
    void stop() noexcept override {
        worker_.stop();
        held_arm_.set_motor_force(glm::dvec3(0.0));
    }
    const char* notice() const noexcept override { return worker_.notice(); }

  private:
    void move_target(const SpaceMouseState& mouse, double elapsed_s) noexcept;

    ArmModel arm_;
    std::function<double()> clock_s_;
    HeldArm held_arm_;
    glm::dvec3 target_mm_;  // device space, both
    glm::dvec3 spindle_axis_;
    std::size_t burr_;
    std::size_t burr_count_;
    bool was_next_pressed_ = false;
    Permission permission_;
    double read_at_s_ = 0.0;
    TripleBuffer<SpaceMouseReading> readings_;
    HidWorker worker_;  // last: its thread uses the readings
};

}  // namespace osteomill
