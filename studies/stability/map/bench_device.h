// The haptic device of a scene: arm and hand moved finely between ticks, delay line, motor limit; encoder
// steps and Coulomb friction only where the case has a real device. Keeps a record, tick by tick.
//
// The order within a tick: the motion reaches the tick's time, the sensor is read, the loop answers, its
// answer waits in the delay line, the motors give their possible force until the next tick.
#pragma once

#include <deque>
#include <functional>
#include <vector>

#include "devices/position_sensor.h"
#include "simulation/device/haptic_device.h"
#include "studies/stability/map/map_case.h"
#include "studies/stability/map/scene_plan.h"

namespace osteomill::study {

/// The energy that a held force takes from the device: each force with the displacement that it acted over.
///
///     taken = - sum_n u_n (x_{n+1} - x_n)
///
/// u_n was set at tick n and held until tick n + 1. An observer that multiplies force and backward-difference
/// velocity pairs u_n with the displacement before it, x_n - x_{n-1}, and never sees the excess energy that a
/// hold gives back.
class EnergyLedger {
  public:
    void held(double force_n, double displacement_m) { taken_j_ -= force_n * displacement_m; }

    /// Negative: the force gave more than it took.
    double taken_j() const { return taken_j_; }

  private:
    double taken_j_ = 0.0;
};

/// From the release on.
struct DeviceTick {
    glm::dvec3 tool_mm{0.0};  ///< where it really is
    glm::dvec3 force_n{0.0};  ///< the motors', from here to the next tick
    double taken_mj = 0.0;    ///< by the force from the release to the next tick
};

class BenchDevice final : public HapticDevice {
  public:
    static constexpr int substeps = 100;  ///< per tick: 10 us

    BenchDevice(const MapCase& c, const ScenePlan& plan);

    /// Called when the motion has reached a tick's time, with the recording up to then.
    void on_tick(std::function<void(const std::vector<DeviceTick>&)> observer) {
        observer_ = std::move(observer);
    }

    std::string name() const override { return "bench"; }
    DeviceLimits limits() const override;
    void start() override {}
    DeviceState read(double now_s) noexcept override;
    void write(const glm::dvec3& force_n) noexcept override;
    void stop() noexcept override {}

    const std::vector<DeviceTick>& record() const { return record_; }

  private:
    void move_to_next_tick();

    ScenePlan plan_;
    double resolution_mm_;
    double max_force_n_;
    PositionSensor sensor_;
    std::deque<glm::dvec3> in_delay_n_;
    std::function<void(const std::vector<DeviceTick>&)> observer_;

    bool has_begun_ = false;
    std::size_t guided_left_;
    ToolMotion motion_;
    glm::dvec3 motor_force_n_{0.0};
    EnergyLedger ledger_;  // mm and N: mJ
    std::vector<DeviceTick> record_;
};

}  // namespace osteomill::study
