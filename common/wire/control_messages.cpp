#include "common/wire/control_messages.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "common/bone/patient_space.h"
#include "common/text/foreign_text.h"
#include "common/wire/geometry_messages.h"

namespace osteomill {

namespace {

static_assert(static_cast<int>(SessionAction::mark) == v2::SESSION_ACTION_MARK &&
                  static_cast<int>(SessionAction::fixture) == v2::SESSION_ACTION_FIXTURE,
              "the actions have the numbers of the message");

SessionAction action_from(v2::SessionAction action) {
    const bool is_known = action >= v2::SESSION_ACTION_MARK && action <= v2::SESSION_ACTION_FIXTURE;
    return is_known ? static_cast<SessionAction>(action) : SessionAction::none;
}

}  // namespace

v2::SessionControl to_message(const SessionControl& control) {
    v2::SessionControl message;
    message.set_action(static_cast<v2::SessionAction>(control.action));
    message.set_text(control.text);
    if (control.action == SessionAction::place) {
        write(control.pose.position_mm, *message.mutable_burr_position_mm());
        write(control.pose.spindle_axis, *message.mutable_spindle_axis());
    }
    if (control.action == SessionAction::speed) message.set_spindle_rpm(control.spindle_rpm);
    if (control.action == SessionAction::fixture) message.set_on(control.is_on);
    return message;
}

v2::SessionEvent to_message(const ControlEvent& event) {
    v2::SessionEvent message;
    message.set_time_s(event.time_s);
    message.set_action(static_cast<v2::SessionAction>(event.action));
    message.set_text(event.text);
    message.set_is_refused(event.is_refused);
    return message;
}

v2::SessionStatus to_message(const SessionStatus& status) {
    v2::SessionStatus message;
    message.set_undo_steps(status.undo_steps);
    message.set_redo_steps(status.redo_steps);
    message.set_is_paused(status.is_paused);
    message.set_may_control(status.may_control);
    message.set_recording_problem(status.recording_problem);
    return message;
}

std::variant<SessionControl, WireError> session_control_from(const v2::SessionControl& message) {
    const SessionAction action = action_from(message.action());
    if (action == SessionAction::none)
        return WireError{"session control " + std::to_string(message.action()) + " is not one that is known"};
    if (message.text().size() > SessionControl::longest_text)
        return WireError{"the text of a session control has " + std::to_string(message.text().size()) +
                         " bytes; " + std::to_string(SessionControl::longest_text) + " are the most"};
    SessionControl control{action, one_line(message.text())};
    if (action == SessionAction::place) {
        if (!message.has_burr_position_mm()) return WireError{"a place for the tool has no position"};
        control.pose = {read(message.burr_position_mm()), read(message.spindle_axis())};
        const auto axis = unit_direction(control.pose.spindle_axis);
        if (!is_finite(control.pose.position_mm) || !axis)
            return WireError{"the place for the tool is not a finite position and a direction"};
        control.pose.spindle_axis = *axis;
    }
    if (action == SessionAction::speed) {
        control.spindle_rpm = message.spindle_rpm();
        if (!is_spindle_speed(control.spindle_rpm))
            return WireError{"the spindle cannot turn at " + std::to_string(control.spindle_rpm) +
                             " rpm: 100 to 500000, or 0 for each burr's own"};
    }
    if (action == SessionAction::fixture) control.is_on = message.on();
    return control;
}

std::variant<std::vector<ControlEvent>, WireError> control_events_from(
    const google::protobuf::RepeatedPtrField<v2::SessionEvent>& messages) {
    std::vector<ControlEvent> events;
    for (const v2::SessionEvent& message : messages) {
        if (!std::isfinite(message.time_s()))
            return WireError{"a session event has a time that is not finite"};
        events.push_back({.time_s = message.time_s(),
                          .action = action_from(message.action()),
                          .text = one_line(message.text()),
                          .is_refused = message.is_refused()});
    }
    return events;
}

SessionStatus session_status_from(const v2::SessionStatus& message) {
    return {.undo_steps = message.undo_steps(),
            .redo_steps = message.redo_steps(),
            .is_paused = message.is_paused(),
            .may_control = message.may_control(),
            .recording_problem = one_line(message.recording_problem())};
}

}  // namespace osteomill
