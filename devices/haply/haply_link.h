// The thread that talks to Haply's service: reconnects when needed, requests the arm's state with each force
// that it sends, and keeps the newest of both for the haptic loop, which waits for neither.
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
#include "devices/clutch.h"
#include "devices/haply/haply_connection.h"
#include "devices/haply/haply_messages.h"
#include "devices/haply/wake_up.h"
#include "devices/position_sensor.h"
#include "simulation/device/fading_force.h"
#include "simulation/exchange/triple_buffer.h"

namespace osteomill {

struct HaplyLinkParts {
    ListenAddress service{.port = 10001};
    std::size_t burr_count = 1;
    std::size_t start_burr = 0;
    glm::dvec3 start_axis{0.0, 0.0, 1.0};  ///< device space, as long as no grip says another
    std::function<void()> on_thread_start = [] {};
};

class HaplyLink {
  public:
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

    /// Begins to talk.
    explicit HaplyLink(HaplyLinkParts parts);
    ~HaplyLink() { stop(); }
    HaplyLink(const HaplyLink&) = delete;
    HaplyLink& operator=(const HaplyLink&) = delete;

    /// Takes the force off the arm and ends the thread. Safe in any state.
    void stop() noexcept;

    /// The loop's, as HapticDevice::read: button a is the pedal, b takes the next burr, c is the clutch.
    DeviceState read(double now_s) noexcept { return readings_.read(now_s); }
    /// The loop's: a force on the hand from now on, device space. Real-time safe.
    void write(const glm::dvec3& force_n) noexcept;

    /// Round trip of a message, the median of the first ones while the arm was there; nullopt before there
    /// are enough, and while it exceeds the limit of a coupling (arm_spring.h). Any thread, like the notice:
    /// a text with static lifetime, empty while all is well.
    std::optional<double> round_trip_s() const noexcept;
    const char* notice() const noexcept { return notice_.load(std::memory_order_relaxed); }

  private:
    void run();
    void converse(HaplyConnection& connection);
    void take(std::string_view text, Clock::time_point now);
    void take_arm(const HaplyInverse3& arm, const std::optional<HaplyGrip>& grip, Clock::time_point now);
    void take_grip(const std::optional<HaplyGrip>& grip);
    void publish() noexcept;
    void lose_arm() noexcept;
    void measure(Clock::duration round_trip);
    void consider_force(Clock::time_point now) noexcept;
    bool ask(HaplyConnection& connection);
    void end(HaplyConnection& connection);
    void say(const char* notice) noexcept { notice_.store(notice, std::memory_order_relaxed); }

    // Of the thread.
    HaplyLinkParts parts_;
    std::string device_id_;  // of the first arm that was seen; another is not taken for it
    HaplyForceField field_ = HaplyForceField::values;
    bool has_arm_ = false;      // as of the newest message
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
    FadingForce sent_force_;
    Clock::time_point requested_;
    Clock::time_point first_request_;  // of what is unanswered: an answer is no older
    Clock::time_point understood_;     // the newest message that made sense
    int unanswered_ = 0;               // messages of ours
    std::string text_;
    std::array<double, answers_measured> round_trips_s_{};
    std::size_t round_trips_ = 0;
    bool is_slow_ = false;  // too slow for any force

    // Between threads.
    ArmReadings readings_;
    TripleBuffer<glm::dvec3> forces_{glm::dvec3(0.0)};
    WakeUp has_new_force_;
    std::atomic<double> round_trip_s_{-1.0};
    std::atomic<const char*> notice_{""};
    std::atomic<bool> stops_{false};
    std::thread thread_;
};

}  // namespace osteomill
