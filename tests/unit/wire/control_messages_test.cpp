#include "common/wire/control_messages.h"

#include <gtest/gtest.h>

#include <limits>

namespace osteomill {
namespace {

TEST(ControlMessages, CarryEveryControl) {
    for (int action = 1; action <= 8; ++action) {
        const SessionControl control{static_cast<SessionAction>(action), "a note"};
        EXPECT_EQ(std::get<SessionControl>(session_control_from(to_message(control))), control);
    }
}

TEST(ControlMessages, CarryASpeedThatASpindleCanHave) {
    for (const double rpm : {0.0, 100.0, 40'000.0, 500'000.0}) {
        const SessionControl control{.action = SessionAction::speed, .spindle_rpm = rpm};
        EXPECT_EQ(std::get<SessionControl>(session_control_from(to_message(control))), control);
    }
    for (const double rpm : {-1.0, 99.0, 500'001.0, std::numeric_limits<double>::quiet_NaN()}) {
        const SessionControl control{.action = SessionAction::speed, .spindle_rpm = rpm};
        EXPECT_TRUE(std::holds_alternative<WireError>(session_control_from(to_message(control)))) << rpm;
    }
}

TEST(ControlMessages, CarryTheSwitchOfAFixture) {
    for (const bool is_on : {false, true}) {
        const SessionControl control{.action = SessionAction::fixture, .text = "Shaft", .is_on = is_on};
        EXPECT_EQ(std::get<SessionControl>(session_control_from(to_message(control))), control);
    }
}

TEST(ControlMessages, CarryEventsAndStatus) {
    const ControlEvent event{
        .time_s = 1.5, .action = SessionAction::redo, .text = "nothing was undone", .is_refused = true};
    google::protobuf::RepeatedPtrField<v2::SessionEvent> messages;
    *messages.Add() = to_message(event);
    EXPECT_EQ(std::get<0>(control_events_from(messages)), std::vector{event});
    const SessionStatus status{.undo_steps = 3,
                               .redo_steps = 2,
                               .is_paused = true,
                               .may_control = true,
                               .recording_problem = "a.pcap: No space left on device"};
    EXPECT_EQ(session_status_from(to_message(status)), status);
}

TEST(ControlMessages, RefuseWhatMakesNoSense) {
    v2::SessionControl control;
    EXPECT_EQ(std::get<WireError>(session_control_from(control)).line,
              "session control 0 is not one that is known");
    control.set_action(v2::SESSION_ACTION_MARK);
    control.set_text(std::string(201, 'x'));
    EXPECT_EQ(std::get<WireError>(session_control_from(control)).line,
              "the text of a session control has 201 bytes; 200 are the most");
    control.set_text("two\nlines");
    EXPECT_EQ(std::get<SessionControl>(session_control_from(control)).text.find('\n'), std::string::npos);
    control.set_action(v2::SESSION_ACTION_PLACE);
    control.mutable_spindle_axis()->set_z(1.0);
    EXPECT_EQ(std::get<WireError>(session_control_from(control)).line, "a place for the tool has no position")
        << "not the origin's";

    google::protobuf::RepeatedPtrField<v2::SessionEvent> events;
    events.Add()->set_time_s(std::numeric_limits<double>::quiet_NaN());
    EXPECT_TRUE(std::holds_alternative<WireError>(control_events_from(events)));
}

TEST(ControlMessages, TakeWhatOnlyANewerServerKnowsForNothing) {
    google::protobuf::RepeatedPtrField<v2::SessionEvent> events;
    events.Add()->set_action(static_cast<v2::SessionAction>(99));
    EXPECT_EQ(std::get<0>(control_events_from(events))[0].action, SessionAction::none);
}

}  // namespace
}  // namespace osteomill
