#include "haptic_server/streaming/control_runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace osteomill {

namespace {

/// A slice that took less, such as one that began as undo was pressed, is undone with the one before: a
/// person would see no change, and read 0.00.
constexpr double least_seen_mm3 = 0.005;

constexpr const char* bone_is_under_way = "the bone is still being given back";

std::string no_such_fixture(const std::string& name, const std::vector<std::string>& known) {
    std::string choices;
    for (const std::string& one : known)
        if (!one.empty()) choices += fmt::format("{}\"{}\"", choices.empty() ? "" : ", ", one);
    if (choices.empty()) return "the session has no fixture that can be switched";
    return fmt::format("the session has no fixture \"{}\"; it has {}", name, choices);
}

bool is_stroke_action(SessionAction action) {
    return action == SessionAction::undo || action == SessionAction::redo || action == SessionAction::reset;
}

}  // namespace

void ControlRunner::control(const SessionControl& control) {
    if (waiting_.size() < most_waiting)
        waiting_.push_back({control});
    else
        say(control, "too much was requested at once");
}

void ControlRunner::begin_frame() {
    has_changes_ = false;
    // Read before the changes are: those that it counts are then among them.
    confirmed_ = gate_.restored_changes.load(std::memory_order_acquire);
}

void ControlRunner::note(const BrickChange& change, const Bone& bone) {
    has_changes_ = true;
    journal_.note(change, bone);
}

void ControlRunner::end_frame(const Bone& bone, const ToolState& tool) {
    time_s_ = tool.time_s;
    const bool goes_on =
        stroke_.goes_on(tool.time_s, tool.spindle_on, has_changes_, tool.force_n != glm::dvec3(0.0));
    if (slice_.ends(tool.time_s, goes_on, has_changes_)) journal_.end_stroke();
    if (requests_.save_news)
        for (std::string& line : requests_.save_news()) say({.action = SessionAction::save}, std::move(line));
    queue_restored();
    if (is_bone_whole() && std::exchange(may_be_in_bone_, false)) lift_out(bone, tool);
    for (Waiting& waiting : waiting_) ++waiting.frames;
    while (!waiting_.empty()) {
        const Waiting& next = waiting_.front();
        const std::string waits_for = act(next, bone, tool);
        if (!waits_for.empty()) {
            if (next.frames < longest_wait_frames) break;
            is_being_placed_ = false;
            say(next.control, waits_for);
        }
        waiting_.pop_front();
    }
    for (const auto& [brick, restored] : restoration_) waits_for_room_.push_back(restored);
    restoration_.clear();
    queue_restored();
    const bool wants_stillness = is_paused_ || is_restoring() || !waiting_.empty();
    gate_.stillness.set(wants_stillness);
}

std::string ControlRunner::act(const Waiting& waiting, const Bone& bone, const ToolState& tool) {
    const SessionControl& control = waiting.control;
    const bool needs_bone = control.action == SessionAction::save ||
                            control.action == SessionAction::finish || control.action == SessionAction::place;
    // A control that needs no bone waits only for its turn.
    const bool can_wait = waiting.frames < longest_wait_frames;
    if (!is_stroke_action(control.action) && !is_bone_whole() && (needs_bone || can_wait))
        return bone_is_under_way;
    switch (control.action) {
        case SessionAction::undo:
        case SessionAction::redo:
        case SessionAction::reset:
            return restore(control.action, bone, tool);
        case SessionAction::place:
            return place(waiting, bone, tool);
        case SessionAction::pause:
        case SessionAction::resume:
            is_paused_ = control.action == SessionAction::pause;
            // At once: a pause that ends in the same frame has been one.
            if (is_paused_) gate_.stillness.set(true);
            break;
        case SessionAction::speed:
            choose_speed(control);
            return {};
        case SessionAction::fixture:
            switch_fixture(control);
            return {};
        case SessionAction::save:
            say(control, requests_.save(bone, control.text));
            return {};
        case SessionAction::finish:
            say({.action = control.action, .text = requests_.finish_words}, requests_.finish());
            return {};
        case SessionAction::mark:
        case SessionAction::none:
            break;
    }
    say(control);
    return {};
}

std::string ControlRunner::restore(SessionAction action, const Bone& bone, const ToolState& tool) {
    if (is_restoring()) return bone_is_under_way;
    if (tool.spindle_on || journal_.has_open_stroke()) return "the stroke under way does not end";
    const bool redoes = action == SessionAction::redo;
    const auto steps = [&] { return redoes ? journal_.redo_steps() : journal_.undo_steps(); };
    if (steps() == 0) {
        say({action}, redoes ? "nothing is left to redo" : "nothing is left to undo");
        return {};
    }
    double mm3 = 0.0;
    do {
        const std::int64_t levels =
            redoes ? journal_.redo(bone, restoration_) : journal_.undo(bone, restoration_);
        mm3 += static_cast<double>(levels) / 255.0 * voxel_volume_mm3(bone.grid());
    } while (steps() > 0 && (action == SessionAction::reset || (!redoes && mm3 < least_seen_mm3)));
    may_be_in_bone_ = true;
    say({.action = action,
         .text = std::abs(mm3) < least_seen_mm3 ? fmt::format("less than {} mm³", 0.01)
                                                : fmt::format("{:.2f} mm³", std::abs(mm3))});
    return {};
}

void ControlRunner::lift_out(const Bone& bone, const ToolState& tool) {
    if (!requests_.lift_out) return;
    const ToolPose pose{tool.burr_position_mm, tool.spindle_axis};
    if (const auto clear = requests_.lift_out(bone, pose, tool.burr))
        waiting_.push_front({.control = {.action = SessionAction::place, .pose = *clear}, .lifts_out = true});
}

std::string ControlRunner::place(const Waiting& waiting, const Bone& bone, const ToolState& tool) {
    // The haptic loop has a frame to place the tool, and another in which it may see that it need not any
    // more.
    const int frames_left = longest_wait_frames - waiting.frames;
    if (!is_being_placed_) {
        if (!requests_.place) {
            say(waiting.control, "the simulated hand follows its own way");
            return {};
        }
        if (tool.spindle_on) return "the spindle still turns";
        if (frames_left < 2) return "what was requested before it took too long";
        const auto found = requests_.place(bone, waiting.control.pose, tool.burr);
        if (const auto* refusal = std::get_if<std::string>(&found)) {
            say(waiting.control, *refusal);
            return {};
        }
        placement_ = {placement_.number + 1, std::get<ToolPose>(found)};
        ask_for(placement_);
        is_being_placed_ = true;
    } else if (gate_.placed.load(std::memory_order_acquire) == placement_.number) {
        say_placed(waiting);
        return {};
    } else if (frames_left == 1) {
        ask_for({.number = gate_.placed.load(std::memory_order_acquire), .pose = {}});
    }
    const std::string fault(tool.fault.text());
    return fault.empty() ? "force and spindle do not go off" : fault;
}

void ControlRunner::ask_for(const Placement& placement) {
    placements_.back() = placement;
    placements_.publish();
}

void ControlRunner::say_placed(const Waiting& waiting) {
    is_being_placed_ = false;
    const SessionControl& control = waiting.control;
    const glm::dvec3& at = placement_.pose.position_mm;
    const double moved_mm = glm::distance(at, control.pose.position_mm);
    say({control.action, moved_mm > 0.05
                             ? fmt::format("at {:.1f}, {:.1f}, {:.1f} mm LPS, {:.1f} mm out of the bone",
                                           at.x, at.y, at.z, moved_mm)
                             : fmt::format("at {:.1f}, {:.1f}, {:.1f} mm LPS", at.x, at.y, at.z)});
    if (requests_.placed && !waiting.lifts_out) requests_.placed(placement_.pose);
}

void ControlRunner::choose_speed(const SessionControl& control) {
    gate_.spindle_rpm.store(static_cast<std::uint32_t>(std::lround(control.spindle_rpm)),
                            std::memory_order_relaxed);
    say({.action = control.action,
         .text = control.spindle_rpm == 0.0 ? "each burr's own"
                                            : fmt::format("{:.0f} rpm", control.spindle_rpm)});
}

void ControlRunner::switch_fixture(const SessionControl& control) {
    const auto found = std::ranges::find(requests_.fixtures, control.text);
    if (control.text.empty() || found == requests_.fixtures.end()) {
        say(control, no_such_fixture(control.text, requests_.fixtures));
    } else if (!is_paused_) {
        say(control, "pause the session first");
    } else {
        const auto number = static_cast<std::size_t>(found - requests_.fixtures.begin());
        const FixtureSet on = gate_.fixtures_on.load(std::memory_order_relaxed);
        const FixtureSet bit = fixture_bit(number);
        gate_.fixtures_on.store(control.is_on ? on | bit : on & ~bit, std::memory_order_relaxed);
        say({.action = control.action,
             .text = fmt::format("{}: {}", control.text, control.is_on ? "on" : "off")});
    }
}

void ControlRunner::queue_restored() {
    for (; !waits_for_room_.empty(); waits_for_room_.pop_front()) {
        const StrokeJournal::Restored& brick = waits_for_room_.front();
        if (!restored_.try_push(brick.change, brick.fractions)) return;
        ++queued_;
    }
}

void ControlRunner::say(const SessionControl& control, std::string refusal) {
    const bool is_refused = !refusal.empty();
    events_.push_back({.time_s = time_s_,
                       .action = control.action,
                       .text = is_refused ? std::move(refusal) : control.text,
                       .is_refused = is_refused});
}

SessionStatus ControlRunner::status() const {
    // A stroke under way counts: undo ends it.
    const std::size_t undo_steps = journal_.undo_steps() + (journal_.has_open_stroke() ? 1 : 0);
    return {.undo_steps = static_cast<std::uint32_t>(undo_steps),
            .redo_steps = static_cast<std::uint32_t>(journal_.redo_steps()),
            .is_paused = is_paused_,
            .recording_problem = requests_.recording_problem ? requests_.recording_problem() : std::string()};
}

}  // namespace osteomill
