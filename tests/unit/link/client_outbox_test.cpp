#include "render_client/link/client_outbox.h"

#include <gtest/gtest.h>

#include <string>

#include "common/wire/control_messages.h"
#include "common/wire/scene_messages.h"

namespace osteomill {
namespace {

SessionInfo session_that_accepts_all() {
    SessionInfo session;
    session.burrs.resize(2);
    session.accepts_operator = session.accepts_controls = true;
    session.has_ct = session.records_view = true;
    return session;
}

v2::OperatorInput input_at(double x_mm) {
    return to_message(OperatorCommand{.hand_target_mm = {x_mm, 0.0, 0.0}});
}

v2::SessionControl mark(const std::string& text) {
    return to_message(SessionControl{.action = SessionAction::mark, .text = text});
}

TEST(ClientOutbox, SendsControlsInOrderAndOfAllElseTheNewest) {
    ClientOutbox outbox;
    outbox.begin(session_that_accepts_all());
    for (const double x_mm : {1.0, 2.0}) outbox.put(input_at(x_mm));
    for (const char* text : {"a", "b"}) outbox.put(mark(text));
    for (const double angle : {0.5, 0.7}) outbox.put(Viewpoint{.field_of_view_rad = angle});
    outbox.request_ct();
    EXPECT_TRUE(outbox.next()->has_hello());
    EXPECT_TRUE(outbox.next()->has_ct_request());
    EXPECT_EQ(outbox.next()->session_control().text(), "a");
    EXPECT_EQ(outbox.next()->session_control().text(), "b");
    EXPECT_TRUE(outbox.next()->has_viewpoint());
    const auto last = outbox.next();
    EXPECT_EQ(last->operator_input().number(), 2U) << "the first is out of date";
    EXPECT_EQ(last->sequence(), 6U);
    EXPECT_FALSE(outbox.next());
}

TEST(ClientOutbox, DropsWhatTheSessionDoesNotAccept) {
    ClientOutbox outbox;
    SessionInfo session;
    session.burrs.resize(1);
    outbox.begin(session);
    EXPECT_TRUE(outbox.next()->has_hello());
    outbox.put(input_at(1.0));
    outbox.put(mark("a"));
    outbox.put(Viewpoint{});
    outbox.request_ct();
    EXPECT_FALSE(outbox.next());

    outbox.begin(session_that_accepts_all());
    EXPECT_TRUE(outbox.next()->has_hello());
    EXPECT_FALSE(outbox.next()) << "a viewpoint says that the session's bone is drawn";
    outbox.put(Viewpoint{});
    EXPECT_TRUE(outbox.next()->has_viewpoint()) << "though it is the one of before";
    for (std::size_t i = 0; i < ClientOutbox::most_waiting_controls + 10; ++i) outbox.put(mark("m"));
    for (std::size_t i = 0; i < ClientOutbox::most_waiting_controls; ++i) EXPECT_TRUE(outbox.next());
    EXPECT_FALSE(outbox.next());
}

TEST(ClientOutbox, ForgetsAllAtTheEndOfAConnection) {
    ClientOutbox outbox;
    outbox.begin(session_that_accepts_all());
    outbox.put(Viewpoint{});
    outbox.put(mark("a"));
    outbox.end();
    EXPECT_FALSE(outbox.next());
    outbox.begin(session_that_accepts_all());
    EXPECT_EQ(outbox.next()->sequence(), 1U);
    EXPECT_FALSE(outbox.next());
}

}  // namespace
}  // namespace osteomill
