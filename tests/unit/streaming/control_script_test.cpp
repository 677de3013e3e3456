#include "haptic_server/streaming/control_script.h"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/message_of.h"

namespace osteomill {
namespace {

ControlScript read(const std::string& text) {
    return read_control_script(text, "s.csv");
}

std::string refusal(const std::string& text) {
    return testing::message_of<std::runtime_error>([&] { (void)read(text); });
}

TEST(ControlScript, IsReadLineByLine) {
    const ControlScript script =
        read("t_s,action,text\n\n# a comment\n1.5,mark,left, then right\r\n1.5,undo,\n");
    ASSERT_EQ(script.size(), 2U);
    EXPECT_EQ(script[0], (TimedControl{1.5, {SessionAction::mark, "left, then right"}}));
    EXPECT_EQ(script[1], (TimedControl{1.5, {SessionAction::undo}}));
}

TEST(ControlScript, KnowsEveryAction) {
    const ControlScript script = read(
        "t_s,action,text\n0,mark,\n0,pause,\n0,resume,\n0,undo,\n0,redo,\n0,reset,\n0,save,\n0,finish,\n"
        "1,speed,30000\n1,speed,0\n2,fixture,Off the nerve, near=off\n3,fixture,a=b=on\n");
    EXPECT_EQ(script.size(), 12U);
    EXPECT_EQ(script[7].control.action, SessionAction::finish);
    EXPECT_EQ(script[8].control.spindle_rpm, 30'000.0);
    EXPECT_EQ(script[9].control.spindle_rpm, 0.0);
    EXPECT_EQ(script[10].control,
              (SessionControl{.action = SessionAction::fixture, .text = "Off the nerve, near"}));
    EXPECT_EQ(script[11].control,
              (SessionControl{.action = SessionAction::fixture, .text = "a=b", .is_on = true}));
}

TEST(ControlScript, SaysWithFileAndLineWhatIsWrong) {
    EXPECT_EQ(refusal(""), "s.csv:1: the first line must be t_s,action,text");
    EXPECT_EQ(refusal("time\n"), "s.csv:1: the first line must be t_s,action,text");
    EXPECT_EQ(refusal("t_s,action,text\n1,undo\n"),
              "s.csv:2: has fewer than the three columns t_s,action,text");
    EXPECT_EQ(
        refusal("t_s,action,text\n1,undu,\n"),
        "s.csv:2: action 'undu' is not one of mark, pause, resume, undo, redo, reset, save, finish, speed, "
        "fixture");
    EXPECT_EQ(refusal("t_s,action,text\n-1,undo,\n"),
              "s.csv:2: t_s '-1' is not a number of seconds, 0 or more");
    EXPECT_EQ(refusal("t_s,action,text\nnan,undo,\n"),
              "s.csv:2: t_s 'nan' is not a number of seconds, 0 or more");
    EXPECT_EQ(refusal("t_s,action,text\n1,speed,fast\n"),
              "s.csv:2: the speed 'fast' is not a number of rev/min, 0 or more");
    EXPECT_EQ(refusal("t_s,action,text\n1,speed,99\n"),
              "s.csv:2: the speed is 100 to 500000 rpm, or 0 for each burr's own");
    for (const char* text : {"Shaft", "Shaft=", "Shaft=yes", "=on"})
        EXPECT_EQ(refusal(std::string("t_s,action,text\n1,fixture,") + text + "\n"),
                  std::string("s.csv:2: the text '") + text + "' is not a fixture's name, then =on or =off");
    EXPECT_EQ(refusal("t_s,action,text\n2,undo,\n1,redo,\n"),
              "s.csv:3: t_s must not be earlier than on the line before");
    EXPECT_EQ(refusal("t_s,action,text\n2,mark," + std::string(201, 'x') + "\n"),
              "s.csv:2: the text has 201 bytes; 200 are the most");
}

}  // namespace
}  // namespace osteomill
