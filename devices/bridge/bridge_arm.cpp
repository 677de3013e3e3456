#include "devices/bridge/bridge_arm.h"

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "common/text/foreign_text.h"
#include "simulation/device/arm_spring.h"

namespace osteomill {

namespace {

constexpr int longest_datagram_wait_ms = 5;
constexpr auto nap = std::chrono::milliseconds(5);
constexpr std::uint64_t ns_per_ms = 1'000'000;
/// A pose that no force of the loop has answered by then is answered with the one before.
constexpr std::uint64_t longest_answer_ns = 3 * ns_per_ms;
/// For so long the last refusal counts as the reason for the wait: an arm that is refused sends a new hello
/// several times a second.
constexpr std::uint64_t stranger_lasts_ns = 3000 * ns_per_ms;

glm::dvec3 vector_of(const double (&values)[3]) {
    return {values[0], values[1], values[2]};
}

double seconds(std::uint64_t ns) {
    return 1e-9 * static_cast<double>(ns);
}

}  // namespace

BridgeArm::BridgeArm(const BridgeAddress& where, Parts parts)
    : socket_(where),
      parts_(std::move(parts)),
      host_(parts_.key, parts_.random),
      burr_(parts_.start_burr),
      readings_([] { return seconds(omb_now_ns()); }) {
    thread_ = std::thread([this] {
        parts_.on_thread_start();
        run();
    });
}

bool BridgeArm::await(const std::function<bool()>& gives_up) {
    while (!has_joined_.load(std::memory_order_acquire)) {
        if (gives_up()) return false;
        std::this_thread::sleep_for(nap);
    }
    return true;
}

std::string BridgeArm::name() const {
    const auto* end = std::find(std::begin(arm_.name), std::end(arm_.name), '\0');
    return printable(std::string(std::begin(arm_.name), end));
}

glm::dvec3 BridgeArm::workspace_middle_mm() const {
    return 0.5 * (vector_of(arm_.workspace_min_mm) + vector_of(arm_.workspace_max_mm));
}

DeviceLimits BridgeArm::limits() const {
    return with_stiffest_spring({.max_force_n = arm_.max_force_n,
                                 .max_stiffness_n_per_mm = arm_.max_stiffness_n_per_mm,
                                 .apparent_mass_kg = arm_.apparent_mass_kg,
                                 .position_resolution_mm = arm_.position_step_mm},
                                round_trip_s());
}

void BridgeArm::write(const glm::dvec3& force_n) noexcept {
    forces_.back() = force_n;
    forces_.publish();
    socket_.wake();
}

void BridgeArm::stop() noexcept {
    stops_.store(true);
    if (thread_.joinable()) thread_.join();
}

BridgeForce BridgeArm::wanted(std::uint64_t now_ns) const {
    if (!is_driven(now_ns)) return {};
    const glm::dvec3& force_n = forces_.front();
    // Bone pushes at the burr, the hand holds the handle.
    return {.force_n = force_n, .torque_n_mm = glm::cross(tool_from_handle_mm_, force_n), .is_off = false};
}

bool BridgeArm::is_driven(std::uint64_t now_ns) const {
    return force_ns_ != 0 && now_ns - force_ns_ < ns_per_ms * longest_force_age_ms;
}

void BridgeArm::take_pose(std::uint64_t now_ns) {
    const omb_pose& pose = host_.pose();
    ArmReading reading{.knows_pedal = true};
    DeviceState& state = reading.state;
    glm::dquat turn(1.0, 0.0, 0.0, 0.0);
    const bool has_orientation = (pose.status & OMB_HAS_ORIENTATION) != 0;
    if (has_orientation)
        turn = glm::normalize(
            glm::dquat(pose.quaternion[0], pose.quaternion[1], pose.quaternion[2], pose.quaternion[3]));
    state.spindle_axis = has_orientation ? turn * glm::dvec3(0.0, 0.0, 1.0) : parts_.start_axis;
    tool_from_handle_mm_ = turn * vector_of(host_.arm()->tool_from_handle_mm);
    state.position_mm = vector_of(pose.position_mm) + tool_from_handle_mm_;

    if (!sensor_) sensor_.emplace(0.0);
    sensor_->read(state.position_mm, seconds(now_ns - sensed_ns_));
    sensed_ns_ = now_ns;
    // The arm's own estimate is of the handle; if that is not the tool, turning it moves the tool, too.
    const bool is_at_tool = tool_from_handle_mm_ == glm::dvec3(0.0);
    state.velocity_mm_per_s = is_at_tool && (pose.status & OMB_HAS_VELOCITY) != 0
                                  ? vector_of(pose.velocity_mm_per_s)
                                  : sensor_->velocity_mm_per_s();
    state.pedal = {.is_down = (pose.buttons & OMB_PEDAL) != 0, .speaker = host_.session()};
    const bool next_pressed = (pose.buttons & OMB_NEXT_BURR) != 0;
    // Before another arm's first pose nothing is known of its keys: one that is held down already asks for
    // nothing.
    if (std::exchange(session_, host_.session()) != host_.session()) was_next_pressed_ = next_pressed;
    if (next_pressed && !was_next_pressed_) burr_ = (burr_ + 1) % parts_.burr_count;
    was_next_pressed_ = next_pressed;
    state.burr = burr_;
    reading.said_s = seconds(host_.said_ns());
    state.connected = (pose.status & OMB_READY) != 0;
    notice_.store(state.connected ? "" : "the arm says that it is not ready: is it calibrated, and held?",
                  std::memory_order_relaxed);
    readings_.publish(reading);
}

void BridgeArm::tell_who_waits() {
    if (has_joined_.load(std::memory_order_relaxed)) return;
    const std::optional<double> round_trip_s = host_.round_trip_median_s();
    if (!round_trip_s) return;
    if (*round_trip_s > longest_delay_s) {
        notice_.store("the arm is too far away: 3 ms there and back is the most that force bears",
                      std::memory_order_relaxed);
        return;
    }
    arm_ = *host_.arm();
    host_.keep_arm();
    round_trip_s_.store(*round_trip_s);
    has_joined_.store(true, std::memory_order_release);
}

void BridgeArm::run() {
    std::array<std::uint8_t, OMB_MESSAGE_BYTES + 1> buffer{};  // one more, to notice too long a message
    PeerAddress from;
    BridgeCounts before;
    std::uint64_t request_ns = 0;
    std::optional<std::uint64_t> refused_ns;
    while (!stops_.load(std::memory_order_relaxed)) {
        const std::optional<std::size_t> bytes = socket_.receive(buffer, from, longest_datagram_wait_ms);
        const std::uint64_t now_ns = omb_now_ns();
        const bool has_force = forces_.refresh();
        if (has_force) force_ns_ = now_ns;
        if (bytes) {
            if (host_.awaits_answer() == false) request_ns = now_ns;
            if (const auto welcome = host_.take(std::span(buffer).first(*bytes), from, now_ns))
                socket_.send(*welcome, from);
            if (host_.has_fresh_pose()) {
                take_pose(now_ns);
                tell_who_waits();
            }
        }
        // The loop's next force takes this pose into account, so it answers the pose; but the loop need not
        // run.
        const bool is_overdue = !is_driven(now_ns) || now_ns - request_ns > longest_answer_ns;
        if (host_.awaits_answer() && (has_force || is_overdue))
            socket_.send(host_.answer(now_ns, wanted(now_ns)), host_.peer());
        if (bytes && host_.has_fresh_pose()) continue;
        const BridgeCounts& now = host_.counts();
        if (now.refused != before.refused) refused_ns = now_ns;
        if (host_.is_gone(now_ns))
            notice_.store(*host_.refusal() != 0 ? host_.refusal()
                          : refused_ns && now_ns - *refused_ns < stranger_lasts_ns
                              ? "no arm is heard; what comes has another key, version or session"
                              : "no arm is heard: is its bridge running?",
                          std::memory_order_relaxed);
        else if (now.late != before.late)
            notice_.store("the arm answers too late: over 50 ms there and back", std::memory_order_relaxed);
        before = now;
    }
}

}  // namespace osteomill
