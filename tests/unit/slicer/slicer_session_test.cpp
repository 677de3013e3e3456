#include "slicer/slicer_session.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"

namespace osteomill {
namespace {

const glm::dvec3 kept_axis(0.0, 0.6, 0.8);

TEST(SlicerSession, TakesMarksPausesAndPlacesInRas) {
    EXPECT_EQ(control_of("Mark", "here", kept_axis),
              (SessionControl{.action = SessionAction::mark, .text = "here"}));
    EXPECT_EQ(control_of("Pause", "1", kept_axis).action, SessionAction::pause);
    EXPECT_EQ(control_of("Pause", "0", kept_axis).action, SessionAction::resume);
    const SessionControl kept = control_of("Place", "1 -2.5 3", kept_axis);
    EXPECT_EQ(kept.pose.position_mm, glm::dvec3(-1.0, 2.5, 3.0));
    EXPECT_EQ(kept.pose.spindle_axis, kept_axis);
    const SessionControl turned = control_of("Place", "1 -2.5 3 0 2 0", kept_axis);
    EXPECT_EQ(turned.pose.spindle_axis, glm::dvec3(0.0, -1.0, 0.0));
}

TEST(SlicerSession, RefusesWhatItDoesNotKnowInOneLine) {
    const auto refused = [](const std::string& name, const std::string& text) -> std::string {
        return testing::message_of<std::invalid_argument>([&] { control_of(name, text, kept_axis); });
    };
    EXPECT_EQ(refused("Mark", "Z\xe4hne"), "Mark 'Z\\xe4hne' is no UTF-8 (byte 2 is \\xe4)");
    EXPECT_EQ(refused("Place", "1 2"), "Place: give \"x y z\" or \"x y z ax ay az\" in RAS, mm");
    EXPECT_EQ(refused("Place", "1 nan 2"), "Place: 'nan' is no number");
    EXPECT_EQ(refused("Place", "1 2 1e9"), "Place: farther than ten metres from the patient's origin");
    EXPECT_EQ(refused("Place", "1 2 3 0 0 0"), "Place: the axis has no direction");
    EXPECT_EQ(refused("Pause", "yes"), "Pause: is neither 1 nor 0");
    EXPECT_EQ(refused("Mark", std::string(201, 'x')), "Mark: 201 bytes; a note has 200 at most");
    EXPECT_EQ(refused("Finish", ""), "a STRING is named Mark, Pause or Place, not 'Finish'");
}

TEST(SlicerSession, SaysItsStateInRas) {
    SessionInfo session;
    session.burrs = {{.name = "round"}};
    session.tissues = {{.name = "bone"}, {.name = "nerve"}};
    ToolState tool{.time_s = 1.5, .force_n = {1.0, 2.0, 3.0}, .removed_mm3 = 4.5};
    const auto text = nlohmann::json::parse(session_text(
        session, tool, {}, {{.tissue = 1, .distance_mm = 0.75, .touches = true}, {.tissue = 9}}));
    EXPECT_EQ(text.at("force_n"), (std::vector<double>{-1.0, -2.0, 3.0}));
    EXPECT_EQ(text.at("burr"), "round");
    EXPECT_EQ(text.at("removed_mm3"), 4.5);
    ASSERT_EQ(text.at("protected").size(), 1U);
    EXPECT_EQ(text.at("protected")[0].at("name"), "nerve");
    EXPECT_EQ(text.at("protected")[0].at("distance_mm"), 0.75);
}

}  // namespace
}  // namespace osteomill
