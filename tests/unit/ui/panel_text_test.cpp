#include "render_client/ui/panels/panel_text.h"

#include <gmock/gmock.h>

namespace osteomill::panel_text_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// All lines, one after the other.
std::string plain(const PanelText& text) {
    std::string all;
    for (const TextLine& line : text) {
        for (const TextPiece& piece : line) all += piece.text;
        all += '\n';
    }
    return all;
}

bool has_tone(const PanelText& text, Tone tone) {
    for (const TextLine& line : text)
        for (const TextPiece& piece : line)
            if (piece.tone == tone) return true;
    return false;
}

class PanelTexts : public ::testing::Test {
  protected:
    PanelTexts() {
        session_.scene_name = "tooth";
        session_.burrs = {{.name = "3 mm", .diameter_mm = 3.0, .edges = 8}};
        content_.session = &session_;
        content_.view = &view_;
        content_.tool = ToolState{.removed_mm3 = 1.234};
        content_.link.status = LinkStatus::live;
        content_.link.status_line = "connected to 127.0.0.1:7010";
    }

    SessionInfo session_;
    ViewSettings view_;
    OverlayContent content_;
};

TEST_F(PanelTexts, SayInAWarningThatAnotherClientHasTheTool) {
    content_.operator_command = OperatorCommand{};
    EXPECT_FALSE(has_tone(operator_text(content_), Tone::warning));
    content_.tool->driver = ToolDriver::another;
    EXPECT_TRUE(has_tone(operator_text(content_), Tone::warning));
    EXPECT_THAT(plain(operator_text(content_)), HasSubstr("another client moves the tool"));
}

TEST_F(PanelTexts, NameNoKeyInAFilm) {
    EXPECT_THAT(plain(session_text(content_)), HasSubstr("F1"));
    view_.playback_shown = false;
    EXPECT_THAT(plain(session_text(content_)), Not(HasSubstr("F1")));
}

TEST_F(PanelTexts, SayWhereForcesAreNotTheBones) {
    EXPECT_FALSE(has_tone(session_text(content_), Tone::warning));
    session_.settings["force_scale"] = "2";
    EXPECT_THAT(plain(session_text(content_)), HasSubstr("forces of cutting times 2"));
    EXPECT_TRUE(has_tone(session_text(content_), Tone::warning));
}

TEST_F(PanelTexts, SayToOneWhoMayOnlyWatchThatItIsSo) {
    EXPECT_TRUE(warning_text(content_).empty());
    content_.tool->driver = ToolDriver::others_only;
    EXPECT_THAT(plain(warning_text(content_)), HasSubstr("you watch"));
    EXPECT_FALSE(has_tone(warning_text(content_), Tone::warning)) << "nothing is wrong";
}

TEST_F(PanelTexts, WarnOnlyWhereThereIsSomethingToWarnOf) {
    EXPECT_TRUE(warning_text(content_).empty());
    content_.tool->touches_protected = true;
    content_.tool->fault = "the device is lost";
    content_.bone_problem = "too large";
    view_.notice = "written: a.png";
    const std::string text = plain(warning_text(content_));
    for (const char* part : {"PROTECTED", "FAULT: the device is lost", "too large", "written: a.png"})
        EXPECT_THAT(text, HasSubstr(part));
}

TEST_F(PanelTexts, TellWhatTheServerWaitsFor) {
    content_.tool->notice = "the burr is changed in the air";
    EXPECT_THAT(plain(warning_text(content_)), HasSubstr("changed in the air"));
    EXPECT_FALSE(has_tone(warning_text(content_), Tone::warning)) << "nothing is wrong";
}

TEST_F(PanelTexts, TellHowFarABoneHasComeAndIsPrepared) {
    EXPECT_THAT(plain(session_text(content_)), ::testing::Not(HasSubstr("preparing")));
    content_.link.status = LinkStatus::receiving_snapshot;
    content_.link.status_line = "receiving the bone from 127.0.0.1:7010";
    content_.link.snapshot_bricks = 300;
    content_.link.snapshot_bricks_total = 400;
    EXPECT_THAT(plain(session_text(content_)), HasSubstr("receiving the bone from 127.0.0.1:7010: 75 %\n"));
    content_.link.status = LinkStatus::live;
    content_.preparation_percent = 43;
    EXPECT_THAT(plain(session_text(content_)), HasSubstr("preparing the bone: 43 %\n"));
    EXPECT_FALSE(has_tone(session_text(content_), Tone::warning)) << "nothing is wrong";
}

TEST_F(PanelTexts, SayTheFirstStepsUntilBoneIsRemoved) {
    content_.operator_command = OperatorCommand{};
    content_.tool->removed_mm3 = 0.0;
    EXPECT_THAT(plain(operator_text(content_)), HasSubstr("Hold SPACE: the burr turns."));
    content_.tool->removed_mm3 = 0.01;
    EXPECT_THAT(plain(operator_text(content_)), ::testing::Not(HasSubstr("Hold SPACE")));
}

TEST_F(PanelTexts, KeepFiguresOfTheLinkForWhoAsks) {
    content_.link.delay.emplace();
    EXPECT_THAT(plain(session_text(content_)), ::testing::Not(HasSubstr("frames/s")));
    view_.details_shown = true;
    EXPECT_THAT(plain(session_text(content_)), AllOf(HasSubstr("frames/s"), HasSubstr("delay")));
}

TEST_F(PanelTexts, AlarmForAFaultAndAProtectedStructureOnly) {
    EXPECT_FALSE(is_alarm(content_));
    content_.bone_problem = "too large";
    view_.notice = "written: a.png";
    EXPECT_FALSE(is_alarm(content_));
    content_.tool->touches_protected = true;
    EXPECT_TRUE(is_alarm(content_));
    content_.tool->touches_protected = false;
    content_.tool->fault = "the device is lost";
    EXPECT_TRUE(is_alarm(content_));
    content_.link.controls.is_paused = true;
    EXPECT_FALSE(is_alarm(content_)) << "it waits for the person";
}

TEST_F(PanelTexts, TellTheToolAndTheSession) {
    EXPECT_THAT(plain(tool_text(content_)), HasSubstr("burr 3.0 mm, 8 edges\nspindle off\nremoved 1.23 mm"));
    EXPECT_FALSE(has_tone(session_text(content_), Tone::warning));
    content_.link.status = LinkStatus::lost;
    EXPECT_TRUE(has_tone(session_text(content_), Tone::warning));
    EXPECT_THAT(plain(session_text(content_)), HasSubstr("connected to 127.0.0.1:7010"));
    content_.sight = SessionSight::silent;
    EXPECT_THAT(plain(session_text(content_)), ::testing::Not(HasSubstr("connected")));
}

}  // namespace
}  // namespace osteomill::panel_text_test
