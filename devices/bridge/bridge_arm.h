// An arm driven by another process, as the loops see it. A thread exchanges messages with it (bridge_host.h);
// the haptic loop takes the newest pose and leaves a force, and waits for neither. That force answers the arm
// at once, so that it comes exactly one tick late.
#pragma once

#include <atomic>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <thread>

#include "devices/arm_readings.h"
#include "devices/bridge/bridge_host.h"
#include "devices/bridge/datagram_socket.h"
#include "devices/position_sensor.h"
#include "simulation/device/haptic_device.h"
#include "simulation/exchange/triple_buffer.h"

namespace osteomill {

class BridgeArm final : public HapticDevice {
  public:
    /// Periods of the loop without a new force after which the arm is sent "no force".
    static constexpr int longest_force_age_ms = 20;

    struct Parts {
        omb_key key{};
        std::size_t burr_count = 1;
        std::size_t start_burr = 0;
        glm::dvec3 start_axis{0.0, 0.0, 1.0};   ///< device space, for arms that state no orientation
        std::function<std::uint64_t()> random;  ///< numbers that nobody can guess
        std::function<void()> on_thread_start = [] {};
    };

    /// Opens the socket, as DatagramSocket does, and begins to listen.
    BridgeArm(const BridgeAddress& where, Parts parts);
    ~BridgeArm() override { stop(); }

    /// Waits until an arm has joined and the delay to it has been measured; false if `gives_up` ends the
    /// wait. Before that nothing is known of the arm.
    bool await(const std::function<bool()>& gives_up);

    const BridgeAddress& address() const { return socket_.address(); }
    /// The median time of a message to the arm and back when it joined, the arm's own wait included.
    double round_trip_s() const { return round_trip_s_.load(); }

    /// Device space.
    glm::dvec3 workspace_middle_mm() const;

    std::string name() const override;
    /// The arm's own limits, with the stiffness lowered to what the measured delay allows.
    DeviceLimits limits() const override;
    /// An arm has joined already: await() has been called.
    void start() override {}
    DeviceState read(double now_s) noexcept override { return readings_.read(now_s); }
    void write(const glm::dvec3& force_n) noexcept override;
    void stop() noexcept override;
    const char* notice() const noexcept override { return notice_.load(std::memory_order_relaxed); }
    /// Counts of the messages over the bridge; to be read once stopped.
    const BridgeCounts& counts() const { return host_.counts(); }

  private:
    void run();
    void take_pose(std::uint64_t now_ns);
    bool is_driven(std::uint64_t now_ns) const;
    BridgeForce wanted(std::uint64_t now_ns) const;
    void tell_who_waits();

    // The thread's own.
    DatagramSocket socket_;
    Parts parts_;
    BridgeHost host_;
    std::optional<PositionSensor> sensor_;
    std::uint64_t sensed_ns_ = 0;
    bool was_next_pressed_ = false;
    std::uint64_t session_ = 0;  // the newest pose's session
    std::size_t burr_ = 0;
    glm::dvec3 tool_from_handle_mm_{0.0};  // device space, as the arm stands now
    std::uint64_t force_ns_ = 0;           // when the loop left the newest

    // Between threads.
    ArmReadings readings_;
    TripleBuffer<glm::dvec3> forces_;
    std::atomic<bool> has_joined_{false};
    std::atomic<double> round_trip_s_{0.0};
    std::atomic<const char*> notice_{""};
    std::atomic<bool> stops_{false};

    // Owned by the loop, and by the thread that waits before it runs.
    omb_arm arm_{};
    std::thread thread_;
};

}  // namespace osteomill
