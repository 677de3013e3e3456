// Haply's Inverse3 with a VerseGrip, as the loops see it. A thread talks to Haply's service: it reconnects
// when needed, requests the arm's state with each force that it sends, and keeps the newest of both for the
// haptic loop, which waits for neither.
//
//   the loop leaves a force -> it is sent -> the service answers with a state -> the loop's next tick has it
//
// The thread does not rely on the service to drop the force: it sends "no force" itself. The arm gets a force
// only while the loop renews it, the arm is there and calibrated, and the clutch is open; after an
// interruption, only once the loop has requested a small force. Until then the arm is reported as lost, so
// that the loop fades its force out and in again, however short the interruption was.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <thread>

#include "common/net/listen_address.h"
#include "devices/arm_readings.h"
#include "devices/haply/haply_connection.h"
#include "devices/haply/haply_messages.h"
#include "devices/position_sensor.h"
#include "devices/wake_up.h"
#include "simulation/device/fade_out.h"
#include "simulation/device/haptic_device.h"
#include "simulation/exchange/triple_buffer.h"

namespace osteomill {

/// Figures of Haply's Inverse3 that coupling and mapping need.
///
/// Axes, as the service has them by default: right-handed, x to the right, y away from the user, z up, the
/// origin at the base (docs.haply.co, Inverse SDK 3.5, "Basis Permutation"). Device space is the same in mm.
/// Positions and forces are those of the cursor, about which the grip turns: the burr's centre is there, so
/// turning the grip does not move the burr.
///
/// No document of the maker's was found that has all of this; if a number is our own, it is on the safe side.
struct Inverse3Profile {
    /// Half of its stated peak, 10 N. A hand that mills feels 1 to 3 N; and a spring of the stiffness below
    /// that is drawn to 10 N holds 50 mJ, which the watchdog sees as a fault when it lets go (15 mJ,
    /// safety/watchdog.h).
    double max_force_n = 5.0;
    /// Our own: the force also passes the service, USB and the service's filters ("Filters", same place).
    double max_stiffness_n_per_mm = 1.0;
    /// Our own, an order of magnitude: the moving links and the grip.
    double apparent_mass_kg = 0.15;
    /// Our own, on the coarse side.
    double position_step_mm = 0.02;
    /// Device space. The maker's example sends the cursor there ("Control Commands").
    glm::dvec3 workspace_middle_mm{0.0, -120.0, 150.0};
    /// From the burr's tip to the shank in the grip's frame: a grip points along its +y ("06. Combined").
    glm::dvec3 spindle_axis_in_grip{0.0, -1.0, 0.0};
};

inline constexpr Inverse3Profile inverse3_profile{};

class HaplyArm final : public HapticDevice {
  public:
    struct Parts {
        ListenAddress service{.port = 10001};
        std::size_t burr_count = 1;
        std::size_t start_burr = 0;
        glm::dvec3 start_axis{0.0, 0.0, 1.0};  ///< device space, as long as no grip says another
        std::function<void()> on_thread_start = [] {};
    };

    using Clock = std::chrono::steady_clock;

    /// A state later than this is not waited for: the force ends.
    static constexpr std::chrono::milliseconds silent_after{20};
    /// A service without a valid message for so long is connected to anew.
    static constexpr std::chrono::milliseconds given_up_after{500};
    static constexpr std::chrono::milliseconds between_tries{200};
    /// A force that the loop has not renewed for so long ends.
    static constexpr std::chrono::milliseconds longest_force_age{20};
    static constexpr double small_force_n = 0.1;
    /// Answers that the delay is taken from.
    static constexpr std::size_t answers_measured = 256;

    /// Begins to look for the service.
    explicit HaplyArm(Parts parts);
    ~HaplyArm() override { stop(); }

    /// Waits until the arm is there and the delay to it has been measured; false if `gives_up` ends the wait.
    bool await(const std::function<bool()>& gives_up);

    /// Delay from a reading to the force that answers it: the round trip to the service, and the loop's tick.
    double delay_s() const { return tick_s + round_trip_s().value_or(0.0); }
    /// Device space.
    glm::dvec3 workspace_middle_mm() const;

    std::string name() const override { return "Haply Inverse3"; }
    /// With the stiffness that is stable at the measured delay.
    DeviceLimits limits() const override;
    void start() override {}
    /// Button a is the pedal, b takes the next burr, c is the clutch.
    DeviceState read(double now_s) noexcept override { return readings_.read(now_s); }
    void write(const glm::dvec3& force_n) noexcept override;
    /// Takes the force off the arm and ends the thread.
    void stop() noexcept override;
    const char* notice() const noexcept override { return notice_.load(std::memory_order_relaxed); }

  private:
    static constexpr double tick_s = 0.001;

    /// Round trip of a message, the median of the first ones while the arm was there; nullopt before there
    /// are enough, and while it exceeds the limit of a coupling (arm_spring.h). Any thread.
    std::optional<double> round_trip_s() const noexcept;
    static double seconds_of(Clock::time_point at) {
        return std::chrono::duration<double>(at.time_since_epoch()).count();
    }
    void run();
    void converse(HaplyConnection& connection);
    void take(std::string_view text, Clock::time_point now);
    void take_arm(const HaplyInverse3& arm, const std::optional<HaplyGrip>& grip, Clock::time_point now);
    void take_grip(const std::optional<HaplyGrip>& grip);
    void lose_arm() noexcept;
    void measure(Clock::duration round_trip);
    void consider_force(Clock::time_point now) noexcept;
    bool ask(HaplyConnection& connection);
    void end(HaplyConnection& connection);
    void say(const char* notice) noexcept { notice_.store(notice, std::memory_order_relaxed); }

    // The thread's own.
    Parts parts_;
    std::string device_id_;  // the first arm that was seen; another is ignored
    HaplyForceField field_ = HaplyForceField::values;
    bool has_arm_ = false;      // whether the newest message has it
    bool is_arm_able_ = false;  // and calibrated, with power
    bool is_calibrated_ = true;
    bool has_power_ = true;
    std::string grip_id_;
    bool was_lost_ = false;  // and the loop has not shown yet that it knows
    bool drives_ = false;
    bool is_clutch_ = false;
    bool was_next_pressed_ = false;
    ArmReading newest_;
    Clutch clutch_;
    PositionSensor sensor_{0.0};
    Clock::time_point sensed_;
    Clock::time_point forced_;  // when the loop left the newest force
    bool has_force_ = false;
    FadeOut sent_force_;
    Clock::time_point requested_;
    Clock::time_point first_request_;  // the oldest unanswered request: an answer is no older
    Clock::time_point understood_;     // the newest message that made sense
    int unanswered_ = 0;               // messages of ours
    std::string text_;
    std::array<double, answers_measured> round_trips_s_{};
    std::size_t round_trips_ = 0;
    bool is_slow_ = false;  // too slow for any force

    // Between threads.
    ArmReadings readings_{[] { return seconds_of(Clock::now()); }};
    TripleBuffer<glm::dvec3> forces_{glm::dvec3(0.0)};
    WakeUp has_new_force_;
    std::atomic<double> round_trip_s_{-1.0};
    std::atomic<const char*> notice_{""};
    std::atomic<bool> stops_{false};
    std::thread thread_;
};

}  // namespace osteomill
