#include "simulation/loop/burr_change.h"

#include <gtest/gtest.h>

#include <string>

namespace osteomill::burr_change_test {
namespace {

/// A burr 0 of three whose milling loop finds, or does not find, the space for the wanted one.
struct Tool {
    BurrChanger burr{0, 3};
    MillingResult latest;
    glm::dvec3 position_mm{0.0};
    bool spindle_on = false;
    double room_mm = 0.1;

    /// A tick, after which the milling loop examines the wanted change.
    void tick(std::optional<std::size_t> asked) {
        burr.tick(asked, spindle_on, position_mm, latest);
        latest.burr = burr.burr();
        latest.wanted_burr = burr.wanted();
        latest.room_for_change_mm = burr.wanted() ? room_mm : 0.0;
    }
};

TEST(BurrChanger, ChangesInTheAirAsSoonAsThatIsKnown) {
    Tool tool;
    tool.tick(2);
    EXPECT_EQ(tool.burr.burr(), 0U) << "nobody has looked yet";
    EXPECT_EQ(tool.burr.waits_for(), BurrChange::bone);
    tool.tick(2);
    EXPECT_EQ(tool.burr.burr(), 2U);
    EXPECT_EQ(tool.burr.waits_for(), BurrChange::none);
    EXPECT_EQ(tool.burr.wanted(), std::nullopt);
}

TEST(BurrChanger, WaitsForTheSpindleAndThenForRoom) {
    Tool tool;
    tool.spindle_on = true;
    tool.room_mm = 0.0;
    for (int i = 0; i < 5; ++i) tool.tick(1);
    EXPECT_EQ(tool.burr.waits_for(), BurrChange::spindle);
    tool.spindle_on = false;
    for (int i = 0; i < 5; ++i) tool.tick(1);
    EXPECT_EQ(tool.burr.burr(), 0U);
    EXPECT_EQ(tool.burr.waits_for(), BurrChange::bone);
    tool.room_mm = 0.1;
    tool.tick(std::nullopt);
    tool.tick(std::nullopt);
    EXPECT_EQ(tool.burr.burr(), 1U) << "the request is not lost";
}

TEST(BurrChanger, DoesNotTrustRoomThatTheToolHasLeft) {
    Tool tool;
    tool.tick(1);
    tool.position_mm = {0.2, 0.0, 0.0};
    tool.tick(1);
    EXPECT_EQ(tool.burr.burr(), 0U);
}

TEST(BurrChanger, DoesNotTakeRoomForOneBurrForRoomForAnother) {
    Tool tool;
    tool.tick(1);
    tool.tick(2);
    EXPECT_EQ(tool.burr.burr(), 0U);
    tool.tick(2);
    EXPECT_EQ(tool.burr.burr(), 2U);
}

TEST(BurrChanger, IsTalkedOutOfAChange) {
    Tool tool;
    tool.room_mm = 0.0;
    tool.tick(1);
    tool.tick(0);
    EXPECT_EQ(tool.burr.waits_for(), BurrChange::none);
    EXPECT_EQ(tool.burr.wanted(), std::nullopt);
}

TEST(BurrChanger, KnowsTheBurrsOfTheSetOnly) {
    Tool tool;
    tool.tick(3);
    tool.tick(3);
    EXPECT_EQ(tool.burr.burr(), 0U);
    EXPECT_EQ(tool.burr.waits_for(), BurrChange::none);
}

TEST(BurrChange, SaysWhatToDo) {
    EXPECT_EQ(std::string(describe(BurrChange::none)), "");
    EXPECT_NE(std::string(describe(BurrChange::spindle)).find("pedal"), std::string::npos);
    EXPECT_NE(std::string(describe(BurrChange::bone)).find("lift it clear"), std::string::npos);
}

}  // namespace
}  // namespace osteomill::burr_change_test
