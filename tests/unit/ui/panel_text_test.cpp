#include "render_client/ui/panels/panel_text.h"

#include <gmock/gmock.h>

#include "studies/render/made_bone.h"

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
        seen_.info = &session_;
        seen_.tool = ToolState{.removed_mm3 = 1.234};
        seen_.link.status = LinkStatus::live;
        seen_.link.status_line = "connected to 127.0.0.1:7010";
    }

    SessionInfo session_;
    ViewSettings view_;
    SeenSession seen_;
    PictureProgress picture_;

    PanelText session_lines() const { return session_text(seen_, picture_, view_, false); }
    PanelText warning_lines() const { return warning_text(seen_, picture_.bone_problem, view_.notice); }
};

TEST_F(PanelTexts, SayInAWarningThatAnotherClientHasTheTool) {
    seen_.operator_command = OperatorCommand{};
    EXPECT_FALSE(has_tone(operator_text(seen_), Tone::warning));
    seen_.tool->driver = ToolDriver::another;
    EXPECT_TRUE(has_tone(operator_text(seen_), Tone::warning));
    EXPECT_THAT(plain(operator_text(seen_)), HasSubstr("another client moves the tool"));
}

TEST_F(PanelTexts, NameNoKeyInAFilm) {
    EXPECT_THAT(plain(session_lines()), HasSubstr("F1"));
    view_.playback_shown = false;
    EXPECT_THAT(plain(session_lines()), Not(HasSubstr("F1")));
}

TEST_F(PanelTexts, SayWhereForcesAreNotTheBones) {
    EXPECT_FALSE(has_tone(session_lines(), Tone::warning));
    session_.settings["force_scale"] = "2";
    EXPECT_THAT(plain(session_lines()), HasSubstr("forces of cutting times 2"));
    EXPECT_TRUE(has_tone(session_lines(), Tone::warning));
}

TEST_F(PanelTexts, SayToOneWhoMayOnlyWatchThatItIsSo) {
    EXPECT_TRUE(warning_lines().empty());
    seen_.tool->driver = ToolDriver::others_only;
    EXPECT_THAT(plain(warning_lines()), HasSubstr("you watch"));
    EXPECT_FALSE(has_tone(warning_lines(), Tone::warning)) << "nothing is wrong";
}

TEST_F(PanelTexts, WarnOnlyWhereThereIsSomethingToWarnOf) {
    EXPECT_TRUE(warning_lines().empty());
    seen_.tool->touches_protected = true;
    seen_.tool->fault = "the device is lost";
    picture_.bone_problem = "too large";
    view_.notice = "written: a.png";
    const std::string text = plain(warning_lines());
    for (const char* part : {"PROTECTED", "FAULT: the device is lost", "too large", "written: a.png"})
        EXPECT_THAT(text, HasSubstr(part));
}

TEST_F(PanelTexts, TellWhatTheServerWaitsFor) {
    seen_.tool->notice = "the burr is changed in the air";
    EXPECT_THAT(plain(warning_lines()), HasSubstr("changed in the air"));
    EXPECT_FALSE(has_tone(warning_lines(), Tone::warning)) << "nothing is wrong";
}

TEST_F(PanelTexts, SayForAsLongAsItIsSoThatNothingIsRecordedAndWhatToDo) {
    seen_.link.controls.recording_problem =
        "a.part.pcap: no more than 7 frames could be written: No space left";
    EXPECT_THAT(plain(warning_lines()), AllOf(HasSubstr("NOT RECORDED: a.part.pcap: no more"),
                                              HasSubstr("Make room on the server's disk")));
    EXPECT_TRUE(has_tone(warning_lines(), Tone::warning));
    EXPECT_FALSE(is_alarm(seen_)) << "it harms no structure";
    seen_.link.controls.recording_problem.clear();
    EXPECT_TRUE(warning_lines().empty());
}

TEST_F(PanelTexts, TellHowFarABoneHasComeAndIsPrepared) {
    EXPECT_THAT(plain(session_lines()), ::testing::Not(HasSubstr("preparing")));
    seen_.link.status = LinkStatus::receiving_snapshot;
    seen_.link.status_line = "receiving the bone from 127.0.0.1:7010";
    seen_.link.snapshot_bricks = 300;
    seen_.link.snapshot_bricks_total = 400;
    EXPECT_THAT(plain(session_lines()), HasSubstr("receiving the bone from 127.0.0.1:7010: 75 %\n"));
    seen_.link.status = LinkStatus::live;
    picture_.preparation_percent = 43;
    EXPECT_THAT(plain(session_lines()), HasSubstr("preparing the bone: 43 %\n"));
    EXPECT_FALSE(has_tone(session_lines(), Tone::warning)) << "nothing is wrong";
}

TEST_F(PanelTexts, SayTheFirstStepsUntilBoneIsRemoved) {
    seen_.operator_command = OperatorCommand{};
    seen_.tool->removed_mm3 = 0.0;
    EXPECT_THAT(plain(operator_text(seen_)), HasSubstr("Hold SPACE: the burr turns."));
    seen_.tool->removed_mm3 = 0.01;
    EXPECT_THAT(plain(operator_text(seen_)), ::testing::Not(HasSubstr("Hold SPACE")));
}

TEST_F(PanelTexts, KeepFiguresOfTheLinkForWhoAsks) {
    seen_.link.delay.emplace();
    EXPECT_THAT(plain(session_lines()), ::testing::Not(HasSubstr("frames/s")));
    view_.details_shown = true;
    EXPECT_THAT(plain(session_lines()), AllOf(HasSubstr("frames/s"), HasSubstr("delay")));
}

TEST_F(PanelTexts, AlarmForAFaultAndAProtectedStructureOnly) {
    EXPECT_FALSE(is_alarm(seen_));
    picture_.bone_problem = "too large";
    view_.notice = "written: a.png";
    EXPECT_FALSE(is_alarm(seen_));
    seen_.tool->touches_protected = true;
    EXPECT_TRUE(is_alarm(seen_));
    seen_.tool->touches_protected = false;
    seen_.tool->fault = "the device is lost";
    EXPECT_TRUE(is_alarm(seen_));
    seen_.link.controls.is_paused = true;
    EXPECT_FALSE(is_alarm(seen_)) << "it waits for the person";
}

TEST_F(PanelTexts, TellTheWayToBoneUnlessTheBurrTouchesSome) {
    const Bone bone = made_bone({.size_voxels = {16, 16, 16}}, [](const glm::dvec3& p) { return 0.5 - p.z; });
    seen_.operator_command = OperatorCommand{};
    seen_.tool->burr_position_mm = {0.75, 0.75, 4.0};
    seen_.tool->spindle_axis = {0.0, 0.0, 1.0};
    EXPECT_THAT(plain(tool_text(seen_, &bone)), HasSubstr("2.0 mm to the bone ahead"));
    seen_.tool->depth_mm = 0.1;  // at its side
    EXPECT_THAT(plain(tool_text(seen_, &bone)),
                AllOf(HasSubstr("in touch with bone"), Not(HasSubstr("ahead"))));
}

TEST_F(PanelTexts, SayWhyTheSpindleIsOff) {
    const auto spindle = [&] { return plain(tool_text(seen_, nullptr)); };
    seen_.operator_command = OperatorCommand{};
    EXPECT_THAT(spindle(), HasSubstr("spindle off: the pedal is up"));
    seen_.operator_command->pedal = true;
    EXPECT_THAT(spindle(), HasSubstr("spindle off\n"));
    seen_.tool->notice = "the spindle stays off after a fault: let go of the pedal, and press it anew";
    EXPECT_THAT(spindle(), HasSubstr("spindle off: press the pedal anew"));
    seen_.tool->driver = ToolDriver::another;
    EXPECT_THAT(spindle(), HasSubstr("spindle off: another has the tool"));
    seen_.tool->fault = "the device is lost";
    EXPECT_THAT(spindle(), HasSubstr("spindle off: fault"));
    seen_.link.controls.is_paused = true;
    EXPECT_THAT(spindle(), HasSubstr("spindle off: paused"));
}

TEST_F(PanelTexts, TellTheToolAndTheSession) {
    EXPECT_THAT(plain(tool_text(seen_, nullptr)),
                HasSubstr("burr 3.0 mm, 8 edges\nspindle off\nremoved 1.23 mm"));
    EXPECT_FALSE(has_tone(session_lines(), Tone::warning));
    seen_.link.status = LinkStatus::lost;
    EXPECT_TRUE(has_tone(session_lines(), Tone::warning));
    EXPECT_THAT(plain(session_lines()), HasSubstr("connected to 127.0.0.1:7010"));
    seen_.sight = SessionSight::silent;
    EXPECT_THAT(plain(session_lines()), ::testing::Not(HasSubstr("connected")));
}

}  // namespace
}  // namespace osteomill::panel_text_test
