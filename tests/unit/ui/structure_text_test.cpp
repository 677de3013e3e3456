#include <gmock/gmock.h>

#include "render_client/ui/panels/panel_text.h"

namespace osteomill::structure_text_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> lines_of(const PanelText& text) {
    std::vector<std::string> lines;
    for (const TextLine& line : text) lines.push_back(line.at(0).text);
    return lines;
}

class StructureTexts : public ::testing::Test {
  protected:
    StructureTexts() {
        session_.tissues = {{.label = 1, .name = "bone"},
                            {.label = 2, .name = "facial nerve", .is_protected = true, .warn_mm = 1.0},
                            {.label = 3, .name = "sinus", .is_protected = true, .warn_mm = 0.5}};
        seen_.info = &session_;
        seen_.tool = ToolState{};
    }
    SessionInfo session_;
    SeenSession seen_;
};

TEST_F(StructureTexts, NameTheNearestWithItsDistance) {
    EXPECT_THAT(lines_of(structure_text(seen_)), ElementsAre("no protected structure near"));
    seen_.link.distances = {{.tissue = 1, .distance_mm = 1.4}, {.tissue = 2, .distance_mm = 0.83}};
    EXPECT_THAT(lines_of(structure_text(seen_)), ElementsAre("sinus: 0.83 mm away"));
    EXPECT_EQ(structure_text(seen_)[0][0].tone, Tone::plain);
    EXPECT_THAT(structure_warnings(seen_), IsEmpty());
}

TEST_F(StructureTexts, WarnWithinTheDistanceOfEachStructure) {
    seen_.link.distances = {{.tissue = 1, .distance_mm = 0.93}, {.tissue = 2, .distance_mm = 0.83}};
    EXPECT_THAT(lines_of(structure_warnings(seen_)),
                ElementsAre("CAREFUL: facial nerve is 0.9 mm away: go slowly"));
    EXPECT_EQ(structure_warnings(seen_)[0][0].tone, Tone::warning);
}

TEST_F(StructureTexts, KeepATouchOnTheScreen) {
    seen_.link.distances = {
        {.tissue = 1, .distance_mm = -0.1, .touches = true, .touches_so_far = 1, .first_touch_s = 3.14}};
    EXPECT_THAT(lines_of(structure_text(seen_)),
                ElementsAre("facial nerve: touching", "touched: facial nerve", "at 3.1 s, for 0.0 s"));
    EXPECT_THAT(lines_of(structure_warnings(seen_)),
                ElementsAre("PROTECTED: the burr touches facial nerve: pull back"));
    seen_.link.distances = {
        {.tissue = 1, .touches_so_far = 2, .first_touch_s = 3.14, .touched_s = 1.5, .entered_mm3 = 0.25}};
    EXPECT_THAT(lines_of(structure_text(seen_)),
                ElementsAre("no protected structure near", "touched: facial nerve, 2 times",
                            "first at 3.1 s, for 1.5 s in all, 0.25 mm³ entered, none of it missing now"));
    seen_.link.distances[0].removed_mm3 = 0.125;
    EXPECT_THAT(lines_of(structure_text(seen_)).back(), HasSubstr(", 0.12 mm³ milled"));

    EXPECT_THAT(structure_warnings(seen_), IsEmpty());
}

TEST_F(StructureTexts, AreNoneWhereNothingIsProtected) {
    session_.tissues = {{.label = 1, .name = "bone"}};
    EXPECT_THAT(structure_text(seen_), IsEmpty());
    EXPECT_THAT(structure_warnings(seen_), IsEmpty());
    // An older server says no more than that.
    seen_.tool->touches_protected = true;
    EXPECT_THAT(lines_of(structure_warnings(seen_)),
                ElementsAre("PROTECTED TISSUE: the burr touches it: pull back"));
}

}  // namespace
}  // namespace osteomill::structure_text_test
