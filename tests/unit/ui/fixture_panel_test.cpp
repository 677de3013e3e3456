#include "render_client/ui/panels/fixture_panel.h"

#include <gmock/gmock.h>

namespace osteomill::fixture_panel_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> lines_of(const PanelText& text) {
    std::vector<std::string> lines;
    for (const TextLine& line : text) lines.push_back(line.at(0).text);
    return lines;
}

class FixturePanel : public ::testing::Test {
  protected:
    FixturePanel() {
        session_.tissues = {{.label = 1, .name = "bone"},
                            {.label = 2, .name = "Facial_Nerve", .is_protected = true}};
        Fixture tube = usual_fixture(FixtureKind::guide);
        tube.name = "Shaft";
        tube.path = LineGuide{{0.0, 0.0, 0.0}, {0.0, 0.0, 10.0}};
        tube.radius_mm = 1.5;
        Fixture off = usual_fixture(FixtureKind::forbidden);
        off.name = "Off it";
        off.tissue = "Facial_Nerve";
        Fixture slow = usual_fixture(FixtureKind::slow);
        slow.name = "Slowly";
        slow.tissue = "Facial_Nerve";
        session_.fixtures = {tube, off, slow};
        seen_.info = &session_;
        seen_.tool = ToolState{.burr_position_mm = {3.0, 0.0, 5.0}, .fixtures_on = 0b111};
    }
    SessionInfo session_;
    SeenSession seen_;
};

TEST_F(FixturePanel, SaysHowFarEachIs) {
    EXPECT_THAT(lines_of(fixture_text(seen_)),
                ElementsAre("Shaft: 1.5 mm away", "Off it: not near", "Slowly: not near"));
    seen_.link.distances = {{.tissue = 1, .distance_mm = 2.6}};
    EXPECT_THAT(lines_of(fixture_text(seen_)),
                ElementsAre("Shaft: 1.5 mm away", "Off it: 1.6 mm away", "Slowly: 0.6 mm away"));
    EXPECT_EQ(fixture_text(seen_)[0][0].tone, Tone::plain);
}

TEST_F(FixturePanel, SaysWhichActAndWhichAreOff) {
    seen_.link.distances = {{.tissue = 1, .distance_mm = 0.8}};
    seen_.tool->fixtures_acting = 0b111;
    EXPECT_THAT(lines_of(fixture_text(seen_)),
                ElementsAre("Shaft: guides, 1.50 mm off", "Off it: holds Facial Nerve off", "Slowly: slows"));
    EXPECT_EQ(fixture_text(seen_)[1][0].tone, Tone::good);
    seen_.tool->fixtures_on = 0;
    seen_.tool->fixtures_acting = 0;
    EXPECT_THAT(lines_of(fixture_text(seen_)), ElementsAre("Shaft: off", "Off it: off", "Slowly: off"));
    EXPECT_EQ(fixture_text(seen_)[2][0].tone, Tone::dim);
}

TEST_F(FixturePanel, IsNoneWhereThereAreNoFixtures) {
    session_.fixtures.clear();
    EXPECT_THAT(fixture_text(seen_), IsEmpty());
}

TEST(GuidesOnAPicture, LeadToTheNearestPlaceOfTheirPath) {
    Fixture guide = usual_fixture(FixtureKind::guide);
    guide.path = LineGuide{{0.0, 0.0, 0.0}, {0.0, 0.0, 10.0}};
    EXPECT_EQ(nearest_of_path(guide, {3.0, 4.0, 5.0}), glm::dvec3(0.0, 0.0, 5.0));
    EXPECT_EQ(nearest_of_path(guide, {3.0, 4.0, 12.0}), glm::dvec3(0.0, 0.0, 10.0));
    guide.path = PlaneGuide{{0.0, 0.0, 2.0}, {0.0, 0.0, 1.0}};
    EXPECT_EQ(nearest_of_path(guide, {3.0, 4.0, 12.0}), glm::dvec3(3.0, 4.0, 2.0));
}

}  // namespace
}  // namespace osteomill::fixture_panel_test
