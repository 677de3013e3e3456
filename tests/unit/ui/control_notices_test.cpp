#include <gtest/gtest.h>

#include "render_client/ui/input/commands.h"

namespace osteomill {
namespace {

constexpr auto undo = SessionAction::undo;
constexpr auto place = SessionAction::place;

TEST(ControlNotices, SayWhatWasUndoneThoughTheBurrIsLiftedOutOfIt) {
    ControlNotices notices;
    EXPECT_EQ(notices.notice_of({.action = undo, .text = "6.09 mm³"}, 10.0), "undone, given back: 6.09 mm³");
    EXPECT_EQ(notices.notice_of({.action = place, .text = "at 1.0, 2.0, 3.0 mm LPS"}, 10.1),
              "undone, given back: 6.09 mm³; the tool is at 1.0, 2.0, 3.0 mm LPS");
    EXPECT_EQ(notices.notice_of({.action = place, .text = "at 1.0, 2.0, 4.0 mm LPS"}, 10.2),
              "the tool is at 1.0, 2.0, 4.0 mm LPS")
        << "said once";
}

TEST(ControlNotices, AreOfOneEventOtherwise) {
    ControlNotices notices;
    notices.notice_of({.action = undo, .text = "6.09 mm³"}, 10.0);
    EXPECT_EQ(notices.notice_of({.action = place, .text = "at 1.0, 2.0, 3.0 mm LPS"}, 20.0),
              "the tool is at 1.0, 2.0, 3.0 mm LPS")
        << "a person placed it later";
    notices.notice_of({.action = undo, .text = "6.09 mm³"}, 30.0);
    EXPECT_EQ(notices.notice_of({.action = SessionAction::mark, .text = "nerve"}, 30.1), "marked nerve");
    EXPECT_EQ(
        notices.notice_of({.action = undo, .text = "nothing is left to undo", .is_refused = true}, 40.0),
        "no undo: nothing is left to undo");
    EXPECT_EQ(notices.notice_of({.action = place, .text = "at 1.0, 2.0, 3.0 mm LPS"}, 40.1),
              "the tool is at 1.0, 2.0, 3.0 mm LPS");
}

TEST(ControlNotices, SayNothingOfAPauseWhichTheWindowSaysWhileItLasts) {
    ControlNotices notices;
    EXPECT_EQ(notices.notice_of({.action = SessionAction::pause}, 10.0), "");
    EXPECT_EQ(notices.notice_of({.action = SessionAction::resume}, 11.0), "the session goes on ");
    EXPECT_EQ(
        notices.notice_of({.action = SessionAction::pause, .text = "it has ended", .is_refused = true}, 12.0),
        "no pause: it has ended");
}

}  // namespace
}  // namespace osteomill
