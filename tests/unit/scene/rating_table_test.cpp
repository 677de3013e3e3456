#include <fmt/format.h>
#include <gmock/gmock.h>

#include "common/scene/scene_file.h"
#include "common/scene/task_tables.h"

namespace osteomill {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string unrated =
    "name = \"a\"\n[bone]\nphantom = \"tooth\"\n"
    "[[tissues]]\nlabel = 1\nname = \"Facial_Nerve\"\ncolour = \"#543622\"\nprotected = true\n"
    "[[tissues]]\nlabel = 2\nname = \"lesion\"\ncolour = \"#543622\"\n";

std::string rating_refusal(const std::string& text) {
    try {
        (void)parse_scene(unrated + text, "case.toml");
    } catch (const SceneError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    return "no error";
}

std::string item_when(const std::string& condition) {
    return "[[rating]]\nname = \"Nerve kept\"\nwhen = \"" + condition + "\"\n";
}

TEST(RatingTable, IsReadAndWritten) {
    const Scene scene = parse_scene(unrated +
                                        R"([[rating]]
name = "Nerve kept"
points = 2.5
when = "structure_touches('Facial_Nerve') == 0"
source = "Our department, 2026"
[[rating]]
name = "Lesion gone"
when = 'region_removed_share > 0.9 and removed_of_tissue_mm3("lesion") > 1'
tissue = "lesion"
[[rating]]
name = "Angle opened"
when = "region_removed_mm3 >= 2"
sphere = { centre_mm = [1, 2, 3], radius_mm = 4 }
[pass]
rating_share = 0.8
)",
                                    "case.toml");
    ASSERT_EQ(scene.rating.size(), 3u);
    EXPECT_EQ(scene.rating[0], (RatingItem{.name = "Nerve kept",
                                           .points = 2.5,
                                           .when = "structure_touches('Facial_Nerve') == 0",
                                           .source = "Our department, 2026"}));
    EXPECT_EQ(scene.rating[1].points, 1.0);
    EXPECT_EQ(scene.rating[1].region, std::optional<PlanRegion>(TissueRegion{"lesion"}));
    EXPECT_EQ(scene.rating[2].region, std::optional<PlanRegion>(SphereRegion{{1, 2, 3}, 4.0}));
    EXPECT_EQ(scene.pass, (PassMarks{{"rating_share", 0.8}}));
    EXPECT_EQ(parse_scene(write_scene(scene), "again.toml"), scene);
    EXPECT_EQ(parse_scene(write_scene(scene, SceneText::complete), "again.toml"), scene);
    EXPECT_TRUE(parse_scene(unrated, "case.toml").rating.empty());
}

TEST(RatingTable, NamesFileItemAndWhatIsMeant) {
    EXPECT_THAT(rating_refusal(item_when("structure_touch('Facial_Nerve') == 0")),
                AllOf(HasSubstr("case.toml:15: [[rating]] \"Nerve kept\": 'when' asks for 'structure_touch'"),
                      HasSubstr("did you mean 'structure_touches'?")));
    EXPECT_THAT(
        rating_refusal(item_when("structure_touches('Facial Nerve') == 0")),
        HasSubstr(
            "of 'Facial Nerve', which is no protected tissue of the scene; did you mean 'Facial_Nerve'?"));
    EXPECT_THAT(rating_refusal(item_when("structure_touches('lesion') == 0")),
                HasSubstr("is no protected tissue"));
    EXPECT_THAT(
        rating_refusal(item_when("structure_nearest_mm > 1")),
        HasSubstr("without saying of which protected tissue; write structure_nearest_mm('Facial_Nerve')"));
    EXPECT_THAT(rating_refusal(item_when("time_s('lesion') > 1")), HasSubstr("it takes no name"));
    EXPECT_THAT(rating_refusal(item_when("plan_removed_share > 0.5")), HasSubstr("the scene has no [plan]"));
    EXPECT_THAT(rating_refusal(item_when("region_removed_share > 0.5")), HasSubstr("the item has no region"));
    EXPECT_THAT(rating_refusal(item_when("burr_cutting_s('9 mm') > 1")),
                HasSubstr("is no burr of the scene"));
    EXPECT_THAT(rating_refusal(item_when("time_s <")), HasSubstr("'when' ends where a number"));
    EXPECT_THAT(rating_refusal("[[rating]]\nwhen = \"time_s < 1\"\n"),
                HasSubstr("'name' is missing in [[rating]]"));
    EXPECT_THAT(rating_refusal("[[rating]]\nname = \"a\"\n"), HasSubstr("'when' is missing in [[rating]]"));
    EXPECT_THAT(rating_refusal(item_when("time_s < 1") + "score = 2\n"), HasSubstr("unknown key 'score'"));
    EXPECT_THAT(rating_refusal(item_when("time_s < 1") + item_when("time_s < 2")),
                HasSubstr("two items of [[rating]] are called \"Nerve kept\""));
    EXPECT_THAT(rating_refusal("[pass]\nrating_share = 0.5\n"), HasSubstr("needs items of [[rating]]"));
    const std::string bare = "name = \"a\"\n[bone]\nphantom = \"cube\"\n";
    try {
        (void)parse_scene(bare + item_when("structure_touches == 0"), "case.toml");
        ADD_FAILURE();
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr("the scene has no protected tissue"));
    }
}

TEST(RatingTable, RefusesWhatIsTooMuchOrNoNumber) {
    for (const char* points : {"nan", "inf", "-1", "0", "1e9", "\"2\""})
        EXPECT_THAT(rating_refusal(item_when("time_s < 1") + "points = " + points + "\n"),
                    HasSubstr("'points'"))
            << points;
    EXPECT_THAT(rating_refusal(item_when("time_s < nan")), HasSubstr("'nan', which is no quantity"));
    EXPECT_THAT(rating_refusal(item_when(std::string(400, '('))), HasSubstr("deep within itself"));
    EXPECT_THAT(rating_refusal(item_when(std::string(501, ' '))), HasSubstr("501 letters; at most 500"));
    EXPECT_THAT(
        rating_refusal("[[rating]]\nname = \"" + std::string(101, 'a') + "\"\nwhen = \"time_s < 1\"\n"),
        HasSubstr("'name' in [[rating]] has 101 letters"));
    EXPECT_THAT(rating_refusal("[[rating]]\nname = \"a\\u001b\"\nwhen = \"time_s < 1\"\n"),
                HasSubstr("'name'"));
    std::string many;
    for (int i = 0; i < 5000; ++i)
        many += fmt::format("[[rating]]\nname = \"{}\"\nwhen = \"time_s < 1\"\n", i);
    EXPECT_THAT(rating_refusal(many), HasSubstr("5000 items of [[rating]]; at most 100 are read"));
    EXPECT_THAT(rating_refusal("rating = 3\n"), HasSubstr("unknown key 'rating'"))
        << "of the tissue above; a list of tables it is not";
    EXPECT_THAT(rating_refusal(item_when("time_s < 1") +
                               "tissue = \"lesion\"\nsphere = { centre_mm = [1, 2, 3], radius_mm = 1 }\n"),
                HasSubstr("[[rating]] takes one of"));
    EXPECT_THAT(
        rating_refusal(item_when("time_s < 1") + "sphere = { centre_mm = [1, nan, 3], radius_mm = 1 }\n"),
        HasSubstr("centre_mm"));
}

}  // namespace
}  // namespace osteomill
