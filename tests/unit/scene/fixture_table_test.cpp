#include <gmock/gmock.h>

#include "common/scene/scene_file.h"
#include "common/scene/task_tables.h"

namespace osteomill::fixture_table_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string without =
    "name = \"a\"\n[bone]\nphantom = \"tooth\"\n"
    "[[tissues]]\nlabel = 1\nname = \"nerve\"\ncolour = \"#543622\"\nprotected = true\n"
    "[[tissues]]\nlabel = 2\nname = \"lesion\"\ncolour = \"#543622\"\n";

const std::string three = R"([[fixture]]
name = "shaft"
kind = "guide"
line = { from_mm = [1, 2, 3], to_mm = [1, 2, -3] }
radius_mm = 0.5
stiffness_n_per_mm = 2.5
[[fixture]]
name = "off the nerve"
kind = "forbidden"
tissue = "nerve"
distance_mm = 1.5
on = false
[[fixture]]
name = "gently"
kind = "slow"
tissue = "nerve"
spindle_share = 0.5
)";

std::string refusal(const std::string& text) {
    try {
        (void)parse_scene(without + text, "case.toml");
    } catch (const SceneError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    return "no error";
}

TEST(FixtureTable, IsReadWithItsKindsDefaultsAndWritten) {
    const Scene scene = parse_scene(without + three, "case.toml");
    ASSERT_EQ(scene.fixtures.size(), 3u);
    Fixture shaft = usual_fixture(FixtureKind::guide);
    shaft.name = "shaft";
    shaft.path = LineGuide{{1, 2, 3}, {1, 2, -3}};
    shaft.radius_mm = 0.5;
    shaft.stiffness_n_per_mm = 2.5;
    EXPECT_EQ(scene.fixtures[0], shaft);
    EXPECT_EQ(scene.fixtures[1].max_force_n, 3.0) << "of a forbidden region";
    EXPECT_EQ(scene.fixtures[1].fade_mm, 0.5);
    EXPECT_FALSE(scene.fixtures[1].is_on);
    EXPECT_EQ(scene.fixtures[2].damping_n_s_per_m, 50.0);
    for (const SceneText extent : {SceneText::concise, SceneText::complete})
        EXPECT_EQ(parse_scene(write_scene(scene, extent), "written"), scene);
}

TEST(FixtureTable, TakesAPlaneOfAnyLength) {
    const Scene scene = parse_scene(without +
                                        "[[fixture]]\nname = \"flat\"\nkind = \"guide\"\n"
                                        "plane = { at_mm = [0, 0, 1], normal = [0, 3, 4] }\n",
                                    "case.toml");
    EXPECT_EQ(scene.fixtures[0].path,
              (std::variant<LineGuide, PlaneGuide>(PlaneGuide{{0, 0, 1}, {0, 0.6, 0.8}})));
    EXPECT_EQ(parse_scene(write_scene(scene), "written"), scene);
}

TEST(FixtureTable, IsChangedFromOutsideItsFile) {
    const Scene scene =
        parse_scene(without + three, "case.toml", {},
                    {.changes = {parse_scene_change("fixture.off the nerve.on=true"),
                                 parse_scene_change("fixture.off the nerve.stiffness_n_per_mm=4")},
                     .option = "--set"});
    EXPECT_TRUE(scene.fixtures[1].is_on);
    EXPECT_EQ(scene.fixtures[1].stiffness_n_per_mm, 4.0);
}

TEST(FixtureTable, SaysInALineWhatIsWrong) {
    const std::string head = "[[fixture]]\nname = \"f\"\nkind = ";
    EXPECT_THAT(refusal(head + "\"wall\"\n"),
                AllOf(HasSubstr("case.toml:15"), HasSubstr("guide"), HasSubstr("forbidden")));
    EXPECT_THAT(refusal(head + "\"guide\"\n"), HasSubstr("either line = {"));
    EXPECT_THAT(refusal(head + "\"guide\"\nline = { from_mm = [1, 1, 1], to_mm = [1, 1, 1] }\n"),
                HasSubstr("one place"));
    EXPECT_THAT(refusal(head + "\"forbidden\"\n"), HasSubstr("tissue"));
    EXPECT_THAT(refusal(head + "\"forbidden\"\ntissue = \"lesion\"\n"),
                AllOf(HasSubstr("no protected tissue"), HasSubstr("\"nerve\"")));
    EXPECT_THAT(refusal(head + "\"forbidden\"\ntissue = \"nerve\"\nline = { from_mm = [0, 0, 0] }\n"),
                HasSubstr("line"));
    EXPECT_THAT(refusal(head + "\"slow\"\ntissue = \"nerve\"\nstiffness_n_per_mm = 1\n"),
                HasSubstr("stiffness_n_per_mm"));
    EXPECT_THAT(refusal(head + "\"guide\"\nreach_mm = 1\nfade_mm = 2\nplane = { at_mm = [0, 0, 0], normal = "
                               "[0, 0, 1] }\n"),
                HasSubstr("'reach_mm' must be above its 'fade_mm' = 2"));
    EXPECT_THAT(refusal(three + head +
                        "\"slow\"\ntissue = \"nerve\"\n[[fixture]]\nname = \"f\"\nkind = "
                        "\"slow\"\ntissue = \"nerve\"\n"),
                HasSubstr("two fixtures are called \"f\""));
}

}  // namespace
}  // namespace osteomill::fixture_table_test
