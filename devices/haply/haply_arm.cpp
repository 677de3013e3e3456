#include "devices/haply/haply_arm.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "simulation/device/arm_spring.h"

namespace osteomill {

namespace {

using namespace std::chrono_literals;

constexpr auto longest_connecting = 500ms;
constexpr auto longest_sending = 50ms;
constexpr auto longest_receiving = 5ms;
/// Between two messages while a force ends.
constexpr auto fading_pace = 1ms;
/// Without a force the arm is still read, at the loop's pace; without an arm there is no hurry.
constexpr int idle_pace_ms = 1;
constexpr int armless_pace_ms = 10;
/// A state that no force of the loop has answered by then is answered with the one before.
constexpr int longest_answer_ms = 3;
constexpr double to_mm = 1000.0;  // from the metres of Haply's service

glm::dvec3 limited(const glm::dvec3& force_n) {
    const double size_n = glm::length(force_n);
    if (!std::isfinite(size_n)) return glm::dvec3(0.0);
    return size_n > inverse3_profile.max_force_n ? force_n * (inverse3_profile.max_force_n / size_n)
                                                 : force_n;
}

}  // namespace

HaplyArm::HaplyArm(Parts parts) : parts_(std::move(parts)) {
    newest_.state.burr = parts_.start_burr;
    newest_.state.spindle_axis = parts_.start_axis;
    thread_ = std::thread([this] {
        parts_.on_thread_start();
        run();
    });
}

bool HaplyArm::await(const std::function<bool()>& gives_up) {
    while (!round_trip_s()) {
        if (gives_up()) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
}

glm::dvec3 HaplyArm::workspace_middle_mm() const {
    return inverse3_profile.workspace_middle_mm;
}

DeviceLimits HaplyArm::limits() const {
    return with_stiffest_spring({.max_force_n = inverse3_profile.max_force_n,
                                 .max_stiffness_n_per_mm = inverse3_profile.max_stiffness_n_per_mm,
                                 .apparent_mass_kg = inverse3_profile.apparent_mass_kg,
                                 .position_resolution_mm = inverse3_profile.position_step_mm},
                                delay_s());
}

void HaplyArm::stop() noexcept {
    stops_.store(true);
    has_new_force_.wake();
    if (thread_.joinable()) thread_.join();
}

void HaplyArm::write(const glm::dvec3& force_n) noexcept {
    forces_.back() = force_n;
    forces_.publish();
    has_new_force_.wake();
}

std::optional<double> HaplyArm::round_trip_s() const noexcept {
    const double measured_s = round_trip_s_.load(std::memory_order_relaxed);
    return measured_s < 0.0 ? std::nullopt : std::optional(measured_s);
}

void HaplyArm::run() {
    while (!stops_.load(std::memory_order_relaxed)) {
        {
            HaplyConnection connection;
            if (connection.open(parts_.service, longest_connecting))
                converse(connection);
            else
                say("Haply's service does not answer: is it running, and on this port?");
        }
        lose_arm();
        constexpr auto nap = 20ms;
        for (auto waited = 0ms; waited < between_tries && !stops_.load(std::memory_order_relaxed);
             waited += nap)
            std::this_thread::sleep_for(nap);
    }
}

void HaplyArm::converse(HaplyConnection& connection) {
    field_ = HaplyForceField::values;
    sent_force_ = {};  // a force sent on an earlier connection ended with it
    unanswered_ = 1;   // the first message comes by itself
    understood_ = requested_ = first_request_ = Clock::now();
    while (!stops_.load(std::memory_order_relaxed)) {
        const std::optional<std::string_view> text =
            connection.receive(sent_force_.is_felt() && !drives_ ? fading_pace : longest_receiving);
        const Clock::time_point now = Clock::now();
        if (!connection.is_open()) {
            say("Haply's service has closed the connection, or speaks no WebSocket");
            return;
        }
        if (text) {
            unanswered_ = std::max(0, unanswered_ - 1);
            take(*text, now);
        }
        if (now - understood_ > given_up_after) {
            if (unanswered_ > 0) say("Haply's service is connected, and silent");
            break;
        }
        if (has_arm_ && now - understood_ > silent_after) lose_arm();
        const bool is_fading = sent_force_.is_felt() && !drives_;
        if (is_fading) {
            // Also into silence, and after nonsense: the service may still hear.
            if (!ask(connection)) return;
        } else if (unanswered_ == 0) {
            has_new_force_.wait(!has_arm_ ? armless_pace_ms : drives_ ? longest_answer_ms : idle_pace_ms);
            consider_force(Clock::now());
            if (!ask(connection)) return;
        }
    }
    end(connection);
}

void HaplyArm::take(std::string_view text, Clock::time_point now) {
    const std::optional<HaplyState> state = parse_haply_state(text, device_id_);
    if (!state) {
        say("what Haply's service says is damaged, or of another kind than that of versions 3.1 to 3.5");
        return;
    }
    understood_ = now;
    if (state->numbers_session) field_ = HaplyForceField::vector;
    if (state->arm) {
        if (has_arm_ && unanswered_ == 0) measure(now - requested_);
        take_arm(*state->arm, state->grip, now);
    } else {
        lose_arm();
        say(device_id_.empty() ? "Haply's service is there, and no Inverse3: is it plugged in and powered?"
                               : "the Inverse3 that there was is not there any more: plug it in again");
    }
}

void HaplyArm::take_arm(const HaplyInverse3& arm, const std::optional<HaplyGrip>& grip,
                        Clock::time_point now) {
    if (device_id_.empty()) device_id_ = arm.device_id;
    if (!has_arm_) sensor_ = PositionSensor(0.0);
    has_arm_ = true;
    is_calibrated_ = arm.is_calibrated.value_or(is_calibrated_);
    has_power_ = arm.has_power.value_or(has_power_);
    is_arm_able_ = is_calibrated_ && has_power_;
    if (!is_arm_able_) was_lost_ = true;

    take_grip(grip);
    sensor_.read(clutch_.position_mm(to_mm * arm.position_m, is_clutch_),
                 std::chrono::duration<double>(now - sensed_).count());
    sensed_ = now;
    newest_.state.position_mm = sensor_.position_mm();
    newest_.state.velocity_mm_per_s = is_clutch_             ? glm::dvec3(0.0)
                                      : arm.velocity_m_per_s ? to_mm * *arm.velocity_m_per_s
                                                             : sensor_.velocity_mm_per_s();
    newest_.state.connected = is_arm_able_ && !was_lost_;
    newest_.said_s = seconds_of(first_request_);
    readings_.publish(newest_);
    say(!has_power_ ? "the Inverse3 has no power: plug its power supply in"
        : !is_calibrated_
            ? "the Inverse3 is not calibrated: put its grip into the inkwell until its light is steady"
        : is_slow_ ? "Haply's service answers too slowly for a force: 2 ms there and back is the most"
        : !newest_.knows_pedal
            ? "no VerseGrip is there: the tool keeps its direction, and the spindle stays off"
            : "");
}

void HaplyArm::take_grip(const std::optional<HaplyGrip>& grip) {
    const bool next_pressed = grip && grip->button_b;
    if (!grip || !newest_.knows_pedal || grip->device_id != grip_id_) {
        ++newest_.state.pedal.speaker;
        was_next_pressed_ = next_pressed;  // held since before it was known: asks for nothing
    }
    newest_.knows_pedal = grip.has_value();
    if (grip) grip_id_ = grip->device_id;
    if (grip) newest_.state.spindle_axis = grip->turn * inverse3_profile.spindle_axis_in_grip;
    is_clutch_ = grip && grip->button_c;
    if (next_pressed && !was_next_pressed_)
        newest_.state.burr = (*newest_.state.burr + 1) % parts_.burr_count;
    was_next_pressed_ = next_pressed;
    newest_.state.pedal.is_down = grip && grip->button_a;
    // A pedal that is held while the clutch closes and opens permits nothing afterwards, since the hand has
    // moved meanwhile.
    if (is_clutch_) ++newest_.state.pedal.speaker;
}

void HaplyArm::lose_arm() noexcept {
    if (has_arm_) was_lost_ = true;
    has_arm_ = is_arm_able_ = drives_ = has_force_ = false;
    newest_.state.connected = newest_.state.pedal.is_down = newest_.knows_pedal = false;
    readings_.publish(newest_);
}

void HaplyArm::measure(Clock::duration round_trip) {
    if (round_trip_s_.load(std::memory_order_relaxed) >= 0.0) return;
    round_trips_s_[round_trips_++] = std::chrono::duration<double>(round_trip).count();
    if (round_trips_ < answers_measured) return;
    const auto middle = round_trips_s_.begin() + answers_measured / 2;
    std::nth_element(round_trips_s_.begin(), middle, round_trips_s_.end());
    round_trips_ = 0;
    is_slow_ = tick_s + *middle > longest_delay_s;
    if (!is_slow_) round_trip_s_.store(*middle, std::memory_order_relaxed);
}

void HaplyArm::consider_force(Clock::time_point now) noexcept {
    if (forces_.refresh()) {
        forced_ = now;
        has_force_ = true;
    }
    const bool is_fresh = has_force_ && now - forced_ <= longest_force_age;
    const bool is_small = is_fresh && glm::length(forces_.front()) <= small_force_n;
    const bool may_drive = is_fresh && is_arm_able_ && !is_clutch_;
    // A loop that stood still, or believes that its force is felt, must not go on from its old place.
    if ((drives_ && !is_fresh) || (may_drive && !drives_ && !is_small)) was_lost_ = true;
    if (is_small && is_arm_able_) was_lost_ = false;
    drives_ = may_drive && !was_lost_ && (drives_ || is_small);
}

bool HaplyArm::ask(HaplyConnection& connection) {
    if (device_id_.empty()) {
        text_ = haply_question;
    } else {
        const std::optional<glm::dvec3> wanted_n =
            drives_ ? std::optional(limited(forces_.front())) : std::nullopt;
        write_haply_force(text_, device_id_, sent_force_.next(wanted_n, seconds_of(Clock::now())), field_);
    }
    requested_ = Clock::now();
    if (unanswered_++ == 0) first_request_ = requested_;
    return connection.send(text_, longest_sending);
}

void HaplyArm::end(HaplyConnection& connection) {
    lose_arm();
    do {
        if (device_id_.empty() || !ask(connection)) return;
        if (sent_force_.is_felt()) connection.receive(fading_pace);
    } while (sent_force_.is_felt());
    // If it were closed at once, the last message might be lost.
    for (const auto until = Clock::now() + longest_sending;
         unanswered_ > 0 && connection.is_open() && Clock::now() < until;)
        if (connection.receive(longest_receiving)) --unanswered_;
}

}  // namespace osteomill
