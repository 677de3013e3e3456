// A device and a coupling that follow a test's script, tick by tick.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "simulation/coupling/coupling.h"
#include "simulation/device/haptic_device.h"

namespace osteomill::testing {

inline constexpr double tick_s = 0.001;

/// Reads the script's value at the session time; remembers the written forces.
class ScriptedDevice final : public HapticDevice {
  public:
    std::function<DeviceState(double)> script = [](double) { return DeviceState{}; };
    DeviceLimits device_limits;
    std::vector<glm::dvec3> written_n;
    int started = 0;
    int stopped = 0;

    ScriptedDevice() { written_n.reserve(100'000); }

    std::string name() const override { return "scripted"; }
    DeviceLimits limits() const override { return device_limits; }
    void start() override { ++started; }
    /// A script's pedal changes when it is read; at the first reading it is up.
    DeviceState read(double now_s) noexcept override {
        DeviceState state = script(now_s);
        if (state.pedal.said_s < 0.0) state.pedal.said_s = now_s;
        if (!was_read_) state.pedal.is_down = false;
        was_read_ = true;
        return state;
    }
    void write(const glm::dvec3& force_n) noexcept override { written_n.push_back(force_n); }
    void stop() noexcept override { ++stopped; }

  private:
    bool was_read_ = false;
};

/// Renders `force`; the burr is rigidly the hand.
class ForcefulCoupling final : public Coupling {
  public:
    std::function<glm::dvec3(const HandState&)> force = [](const HandState&) { return glm::dvec3(0.0); };
    std::vector<HandState> hands;
    int resets = 0;

    CouplingOutput tick(const HandState& hand, const MillingResult&) noexcept override {
        hands.push_back(hand);
        return {.force_n = force(hand), .burr_pose = hand.pose};
    }
    void reset() noexcept override { ++resets; }
    std::unique_ptr<Coupling> copy() const override { return std::make_unique<ForcefulCoupling>(*this); }
};

}  // namespace osteomill::testing
