#include "simulation/loop/haptic_loop.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "common/bone/patient_space.h"
#include "common/scene/device_mapping.h"
#include "common/session/written_pose.h"
#include "simulation/loop/clearance.h"

namespace osteomill {

HapticLoop::HapticLoop(const HapticLoopParts& parts, const HapticLoopOptions& options)
    : parts_(parts),
      options_(options),
      safety_(options.tick_s, parts.device.limits().max_force_n),
      gives_force_(parts.device.limits().gives_force),
      hand_pose_(options.start_pose),
      burr_pose_(options.start_pose),
      burr_(options.start_burr, options.burr_count),
      speed_(options.spindle_rev_per_s),
      fixtures_on_(options.fixtures_on) {}

HapticLoop::HapticLoop(const HapticLoop& other, const HapticLoopParts& parts) : HapticLoop(other) {
    // References are not assigned, but made.
    std::destroy_at(&parts_);
    std::construct_at(&parts_, parts);
}

HandState HapticLoop::hand_state(double now_s, double elapsed_s, const DeviceState& device) noexcept {
    const DeviceMapping& mapping = options_.mapping;
    hand_pose_ = as_written({position_in_patient_mm(mapping, device.position_mm),
                             direction_in_patient(mapping, device.spindle_axis)});
    return {.now_s = now_s,
            .tick_s = elapsed_s,
            .pose = hand_pose_,
            .velocity_mm_per_s = velocity_in_patient_mm_per_s(mapping, device.velocity_mm_per_s),
            .spindle_on = safety_.wants_spindle(),
            .burr = burr_.burr()};
}

bool HapticLoop::holds_still(const MillingResult& latest) noexcept {
    // Bone may come back round the burr: in that very tick nothing may be felt of it.
    const bool is_restored =
        std::exchange(restored_changes_, latest.restored_changes) != latest.restored_changes;
    was_stillness_asked_ = parts_.gate != nullptr && parts_.gate->stillness.was_wanted();
    return is_restored || was_stillness_asked_;
}

/// Only while nobody feels a force: they come in with the next, as after a start.
void HapticLoop::take_fixtures() noexcept {
    const ForceGuard::State force = safety_.state();
    const bool is_off = force == ForceGuard::State::off || force == ForceGuard::State::fading_out;
    if (is_off && parts_.gate != nullptr)
        fixtures_on_ = parts_.gate->fixtures_on.load(std::memory_order_relaxed);
}

bool HapticLoop::place(const DeviceState& device) noexcept {
    if (parts_.placements == nullptr) return false;
    parts_.placements->refresh();
    const Placement& wanted = parts_.placements->front();
    const bool is_done = wanted.number == parts_.gate->placed.load(std::memory_order_relaxed);
    // Only if nobody feels anything: the force has faded out, and comes back when the burr is clear.
    if (is_done || safety_.state() != ForceGuard::State::off || !device.connected ||
        !is_finite(device.position_mm) || !is_finite(device.spindle_axis))
        return false;
    options_.mapping = placed(options_.mapping, device.position_mm, device.spindle_axis, wanted.pose);
    parts_.device.set_mapping(options_.mapping);
    has_met_bone_ = false;
    removed_before_mm3_ = parts_.results.front().total_removed_mm3;
    parts_.gate->placed.store(wanted.number, std::memory_order_release);
    return true;
}

double HapticLoop::speed_share(double chosen_rpm, double elapsed_s) noexcept {
    if (parts_.gate == nullptr) return 1.0;
    return speed_.tick(burr_.burr(), chosen_rpm / 60.0, spindle_turned_, elapsed_s);
}

void HapticLoop::tick(double now_s, std::uint64_t missed_periods) noexcept {
    const double elapsed_s = options_.tick_s * static_cast<double>(1 + missed_periods);
    const DeviceState device = parts_.device.read(now_s);
    const bool is_placed = place(device);
    parts_.results.refresh();
    const MillingResult& latest = parts_.results.front();
    settle(latest.total_removed_mm3, latest.restored_changes);
    steps_ = note_steps(latest);

    const glm::dvec3 reading_mm =
        with_decimals<hand_decimals_mm>(position_in_patient_mm(options_.mapping, device.position_mm));
    // In the device's millimetres, from the pose as it is written: a recorded hand gets the same.
    energy_.add(reading_mm / options_.mapping.scale, felt_n_, elapsed_s,
                Watchdog::jump_allowance_mm + Watchdog::fastest_hand_mm_per_s * elapsed_s);
    safety_.observe({.now_s = now_s,
                     .device = device,
                     .model_step = latest.step,
                     .model_valid = latest.valid,
                     .missed_periods = missed_periods,
                     .energy_to_hand_mj = energy_.lately_mj(),
                     .holds_still = holds_still(latest) || is_placed,
                     .clearance = clearance_of(latest, reading_mm)});

    // From where the burr was: the free space that the milling loop found reaches beyond this tick's motion.
    burr_.tick(device.burr, spindle_turned_ || safety_.is_pedal_good(), burr_pose_.position_mm, latest);

    HandState hand{.now_s = now_s, .tick_s = elapsed_s, .pose = hand_pose_, .burr = burr_.burr()};
    if (safety_.has_hand()) hand = hand_state(now_s, elapsed_s, device);
    const std::uint32_t chosen_rpm =
        parts_.gate != nullptr ? parts_.gate->spindle_rpm.load(std::memory_order_relaxed) : 0;
    hand.speed_share = speed_share(chosen_rpm, elapsed_s);
    if (options_.has_fixtures) {
        take_fixtures();
        hand.fixtures_on = fixtures_on_;
        // As the last tick found it: the coupling looks once a tick where its burr is.
        hand.speed_share *= parts_.coupling.felt_fixtures().spindle_share;
    }

    glm::dvec3 wanted_n(0.0);
    glm::dvec3 shank_torque_n_mm(0.0);
    bool is_sound = true;
    if (safety_.may_touch()) {
        const CouplingOutput output = parts_.coupling.tick(hand, latest);
        wanted_n = output.force_n;
        shank_torque_n_mm = output.shank_torque_n_mm;
        burr_pose_ = output.burr_pose;
        is_sound = is_finite(burr_pose_.position_mm) && is_finite(burr_pose_.spindle_axis);
    }
    if (parts_.vibration != nullptr) {
        const bool is_felt = safety_.may_touch() && safety_.state() == ForceGuard::State::active;
        wanted_n += parts_.vibration->tick(hand, latest, wanted_n, is_felt);
    }

    const bool lets_go = lets_go_.load(std::memory_order_relaxed);
    const glm::dvec3 passed_n = safety_.pass(wanted_n, is_sound, elapsed_s);
    const glm::dvec3 force_n = at_the_end_.next(lets_go ? std::nullopt : std::optional(passed_n), now_s);
    if (safety_.has_just_let_go()) parts_.coupling.reset();
    if (!safety_.holds_tool()) burr_pose_ = hand_pose_;

    parts_.device.write(force_in_device_n(options_.mapping, force_n));
    if (lets_go && !at_the_end_.is_felt()) has_let_go_.store(true, std::memory_order_relaxed);
    // A force that nobody feels gives the hand no energy.
    if (gives_force_) felt_n_ = force_n;
    peak_force_n_ = std::max(peak_force_n_, glm::length(force_n));
    if (latest.touches_protected) protected_until_s_ = now_s + protected_shown_s;

    const bool spindle_on = spindle_turned_ = safety_.spindle_turns() && !lets_go;
    const bool in_contact = latest.total_removed_mm3 > removed_before_mm3_ || force_n != glm::dvec3(0.0);
    tool_ = {.time_s = now_s,
             .burr_position_mm = burr_pose_.position_mm,
             .spindle_axis = burr_pose_.spindle_axis,
             .hand_position_mm = hand_pose_.position_mm,
             .force_n = force_n,
             .burr = burr_.burr(),
             .spindle_on = spindle_on,
             .removed_mm3 = options_.removed_before_mm3 + latest.total_removed_mm3,
             .touches_protected = now_s < protected_until_s_,
             .fault = describe(safety_.fault()),
             .notice = notice(),
             .depth_mm = depth_mm(in_contact),
             .solve = parts_.coupling.solve_counts(),
             .shank_torque_n_mm = options_.has_shank ? std::optional(shank_torque_n_mm) : std::nullopt,
             .peak_force_n = peak_force_n_,
             .spindle_rpm = hand.speed_share != 1.0
                                ? std::optional(60.0 * hand.speed_share * speed_.own_rev_per_s(burr_.burr()))
                                : std::nullopt};
    if (options_.has_fixtures) {
        tool_.fixtures_on = fixtures_on_;
        tool_.fixtures_acting = parts_.coupling.felt_fixtures().acting;
    }
    publish({.tick = ticks_++,
             .pose = burr_pose_,
             .spindle_on = spindle_on,
             .burr = burr_.burr(),
             .speed_share = hand.speed_share,
             .elapsed_s = elapsed_s,
             .wanted_burr = burr_.wanted()});
    fault_ = safety_.fault();
    input_ = input_of(device, lets_go);
    input_.chosen_rpm = chosen_rpm;
    input_.is_placed = is_placed;
    is_settled_ = false;
}

void HapticLoop::settle(double total_removed_mm3, std::uint64_t restored_changes) noexcept {
    if (std::exchange(is_settled_, true)) return;
    input_.restored = static_cast<std::uint32_t>(restored_changes -
                                                 std::exchange(settled_restored_changes_, restored_changes));
    const double removed_mm3 = options_.removed_before_mm3 + total_removed_mm3;
    // On the real clock the state has gone out with the tick's values.
    if (std::exchange(tool_.removed_mm3, removed_mm3) != removed_mm3) show();
    log();
}

std::uint64_t HapticLoop::note_steps(const MillingResult& latest) noexcept {
    std::uint64_t left = latest.step - std::exchange(seen_step_, latest.step);
    std::array<StepRun, newest_step_runs> seen{};
    std::size_t first = seen.size();
    while (left > 0 && first > 0) {
        StepRun run = latest.newest_runs[first - 1];
        if (run.count == 0) break;
        // A run that was under way began at a step that was seen before.
        if (run.count > left) run = {.command = run.command, .count = left};
        left -= run.count;
        seen[--first] = run;
    }
    if (left > 0) return steps_not_told;
    return code_of_steps(std::span(seen).subspan(first), ticks_);
}

TickInput HapticLoop::input_of(const DeviceState& device, bool lets_go) const noexcept {
    using Pedal = TickInput::Pedal;
    TickInput input{.lets_go = lets_go,
                    .steps = steps_,
                    .holds_still = was_stillness_asked_,
                    .switched = fixtures_on_ ^ options_.fixtures_on};
    if (device.burr && *device.burr < options_.burr_count) input.burr = device.burr;
    if (!safety_.has_hand()) {
        input.pedal = Pedal::no_hand;
        return input;
    }
    switch (safety_.pedal_seen()) {
        case PedalSeen::up:
            break;
        case PedalSeen::down:
            input.pedal = Pedal::down;
            break;
        case PedalSeen::waiting:
            input.pedal = Pedal::waiting;
            break;
        case PedalSeen::lapsed:
            input.pedal = Pedal::lapsed;
            break;
    }
    return input;
}

void HapticLoop::publish(const BurrCommand& command) noexcept {
    parts_.commands.back() = command;
    parts_.commands.publish();
    show();
}

void HapticLoop::show() noexcept {
    parts_.tool.back() = tool_;
    parts_.tool.publish();
    parts_.status.back() = tool_;
    parts_.status.publish();
}

namespace {

/// A loop did not get the processor in time: nothing is wrong with arm, hand or bone.
constexpr bool is_of_slow_computer(Fault fault) noexcept {
    return fault == Fault::overrun || fault == Fault::model_stalled;
}

/// Cause and remedy of a held pedal that turns nothing.
const char* why_it_awaits_release(Fault locked_by) noexcept {
    switch (locked_by) {
        case Fault::none:
            return "the spindle stays off, for the pedal was down already at the start, or after nothing was "
                   "heard of it: let go of the pedal, and press it anew";
        case Fault::paused:
            return "the spindle stays off after a pause, an undo or a placing of the tool: let go of the "
                   "pedal, and press it anew";
        case Fault::in_bone:
            return "the spindle stays off, for the burr was inside the bone: pull it back, let go of the "
                   "pedal, and press it anew";
        default:
            return is_of_slow_computer(locked_by)
                       ? "the spindle stays off, for the computer was too slow for a moment: let go of the "
                         "pedal, and press it anew"
                       : "the spindle stays off after a fault: let go of the pedal, and press it anew";
    }
}

}  // namespace

const char* HapticLoop::notice() const noexcept {
    if (safety_.fault() == Fault::in_bone && is_of_slow_computer(safety_.force_taken_by()))
        return "the computer was too slow for a moment: the force went off, and the burr sank into the bone";
    if (burr_.waits_for() == BurrChange::none && safety_.awaits_release())
        return why_it_awaits_release(safety_.spindle_locked_by());
    return describe(burr_.waits_for());
}

double HapticLoop::depth_mm(bool in_contact) noexcept {
    if (in_contact && !has_met_bone_) {
        has_met_bone_ = true;
        first_contact_ = burr_pose_;
    }
    if (!has_met_bone_) return 0.0;
    return glm::dot(first_contact_.position_mm - burr_pose_.position_mm, first_contact_.spindle_axis);
}

void HapticLoop::log() noexcept {
    if (parts_.log == nullptr) return;
    const ToolState& tool = tool_;
    parts_.log->push({.time_s = tool.time_s,
                      .hand_mm = tool.hand_position_mm,
                      .burr_mm = tool.burr_position_mm,
                      .force_n = tool.force_n,
                      .depth_mm = tool.depth_mm.value_or(0.0),
                      .removed_mm3 = tool.removed_mm3,
                      .spindle_on = tool.spindle_on,
                      .fault = static_cast<std::uint8_t>(fault_),
                      .spindle_axis = tool.spindle_axis,
                      .burr = tool.burr,
                      .shank_torque_n_mm = tool.shank_torque_n_mm,
                      .input = input_});
}

}  // namespace osteomill
