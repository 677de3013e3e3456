#include "haptic_server/streaming/session_controls.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <utility>

namespace osteomill {

void SessionControls::control(const SessionControl& control) {
    if (waiting_.size() < most_waiting)
        waiting_.push_back(control);
    else
        say(control, "too much was asked for at once");
}

void SessionControls::begin_frame() {
    has_changes_ = false;
    // Read before the changes are: those that it counts are then among them.
    confirmed_ = gate_.restored_changes.load(std::memory_order_acquire);
}

void SessionControls::note(const BrickChange& change, const Bone& bone) {
    has_changes_ = true;
    journal_.note(change, bone);
}

void SessionControls::end_frame(const Bone& bone, const ToolState& tool) {
    time_s_ = tool.time_s;
    // The milling loop may be a step behind the pedal: the stroke has ended when no more comes of it.
    if (!tool.spindle_on && !has_changes_) journal_.end_stroke();
    queue_restored();
    while (!is_restoring() && !waiting_.empty() && act(waiting_.front(), bone, tool)) waiting_.pop_front();
    const bool wants_stillness = is_paused_ || is_restoring() || !waiting_.empty();
    gate_.holds_still.store(wants_stillness, std::memory_order_release);
}

bool SessionControls::act(const SessionControl& control, const Bone& bone, const ToolState& tool) {
    switch (control.action) {
        case SessionAction::undo:
        case SessionAction::redo:
        case SessionAction::reset:
            return restore(control.action, bone, tool);
        case SessionAction::place:
            return place(control, bone, tool);
        case SessionAction::pause:
        case SessionAction::resume:
            is_paused_ = control.action == SessionAction::pause;
            break;
        case SessionAction::speed:
            choose_speed(control);
            return true;
        case SessionAction::save:
            say(control, requests_.save(bone, control.text));
            return true;
        case SessionAction::finish:
            say({.action = control.action, .text = requests_.finish_words}, requests_.finish());
            return true;
        case SessionAction::mark:
        case SessionAction::none:
            break;
    }
    say(control);
    return true;
}

bool SessionControls::restore(SessionAction action, const Bone& bone, const ToolState& tool) {
    if (tool.spindle_on || journal_.has_open_stroke()) return false;
    const bool redoes = action == SessionAction::redo;
    if ((redoes ? journal_.redo_steps() : journal_.undo_steps()) == 0) {
        // A reset that has undone its last stroke is done.
        const bool is_done = std::exchange(is_resetting_, false);
        say({action}, is_done ? "" : redoes ? "nothing was undone" : "nothing was milled");
        return true;
    }
    const auto restored = redoes ? journal_.redo(bone) : journal_.undo(bone);
    waits_for_room_.insert(waits_for_room_.end(), restored.begin(), restored.end());
    queue_restored();
    if (action == SessionAction::reset) {
        is_resetting_ = true;
        return false;  // its turn comes again, for the stroke before
    }
    say({action});
    return true;
}

bool SessionControls::place(const SessionControl& control, const Bone& bone, const ToolState& tool) {
    if (is_being_placed_) {
        if (gate_.placed.load(std::memory_order_acquire) != placement_.number) return false;
        is_being_placed_ = false;
        const glm::dvec3& at = placement_.pose.position_mm;
        const double moved_mm = glm::distance(at, control.pose.position_mm);
        say({control.action,
             fmt::format(
                 "at {:.1f}, {:.1f}, {:.1f} mm LPS{}", at.x, at.y, at.z,
                 moved_mm > 0.05 ? fmt::format(", {:.1f} mm out of the bone", moved_mm) : std::string())});
        if (requests_.placed) requests_.placed(placement_.pose);
        return true;
    }
    if (!requests_.place) {
        say(control, "the simulated hand follows its own way");
        return true;
    }
    if (tool.spindle_on) return false;
    const auto found = requests_.place(bone, control.pose, tool.burr);
    if (const auto* refusal = std::get_if<std::string>(&found)) {
        say(control, *refusal);
        return true;
    }
    placement_ = {placement_.number + 1, std::get<ToolPose>(found)};
    placements_.back() = placement_;
    placements_.publish();
    is_being_placed_ = true;
    return false;
}

void SessionControls::choose_speed(const SessionControl& control) {
    gate_.spindle_rev_per_s.store(control.spindle_rpm / 60.0, std::memory_order_relaxed);
    say({.action = control.action,
         .text = control.spindle_rpm == 0.0 ? "each burr's own"
                                            : fmt::format("{:.0f} rpm", control.spindle_rpm)});
}

void SessionControls::queue_restored() {
    for (; !waits_for_room_.empty(); waits_for_room_.pop_front()) {
        const StrokeJournal::Restored& brick = waits_for_room_.front();
        if (!restored_.try_push(brick.change, brick.fractions)) return;
        ++queued_;
    }
}

void SessionControls::say(const SessionControl& control, std::string refusal) {
    const bool is_refused = !refusal.empty();
    events_.push_back({.time_s = time_s_,
                       .action = control.action,
                       .text = is_refused ? std::move(refusal) : control.text,
                       .is_refused = is_refused});
}

SessionStatus SessionControls::status() const {
    return {.undo_steps = static_cast<std::uint32_t>(journal_.undo_steps()),
            .redo_steps = static_cast<std::uint32_t>(journal_.redo_steps()),
            .is_paused = is_paused_};
}

}  // namespace osteomill
