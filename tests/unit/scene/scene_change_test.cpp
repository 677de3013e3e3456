#include "common/scene/scene_change.h"

#include <gmock/gmock.h>

#include "common/scene/scene_file.h"
#include "tests/support/message_of.h"

namespace osteomill {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* scene_text = R"(
name = "jaw"
wall_friction = 0.1
[bone]
phantom = "tooth"
[[tissues]]
label = 1
name = "enamel"
colour = "#ffffff"
[[burrs]]
name = "1"
diameter_mm = 1.0
[[burrs]]
name = "1.5 mm"
diameter_mm = 1.5
)";

Scene changed(const std::vector<std::string>& texts) {
    std::vector<SceneChange> changes;
    for (const std::string& text : texts) changes.push_back(parse_scene_change(text));
    return parse_scene(scene_text, "jaw.toml", {}, {changes, "--set"});
}

std::string refusal_of(const std::vector<std::string>& texts) {
    return testing::message_of<SceneError>([&] { changed(texts); });
}

TEST(SceneChange, SetsAnyKey) {
    EXPECT_EQ(changed({"wall_friction=0.3"}).wall_friction, 0.3);
    EXPECT_EQ(changed({"name=a new name"}).name, "a new name");
    EXPECT_EQ(changed({"start_burr=1.5 mm"}).start_burr, 1U);
    EXPECT_EQ(changed({"device.scale=0.5"}).device.scale, 0.5) << "of a table that is not there";
    EXPECT_EQ(changed({"start_pose.position_mm=[1, 2.5, -3]"}).start_pose.position_mm,
              glm::dvec3(1.0, 2.5, -3.0));
    EXPECT_FALSE(changed({"tissues.enamel.cuttable=false"}).tissues.at(0).is_cuttable);
    EXPECT_EQ(changed({"burrs.1.5 mm.edges=4"}).burrs.at(1).edges, 4);
    EXPECT_EQ(changed({"plan.sphere={ centre_mm = [0, 0, 1], radius_mm = 2 }"}).plan,
              (Plan{.region = SphereRegion{{0.0, 0.0, 1.0}, 2.0}}));
}

TEST(SceneChange, LeavesTheRestAsItWas) {
    EXPECT_EQ(changed({}), parse_scene(scene_text, "jaw.toml"));
    EXPECT_EQ(changed({"wall_friction=0.3", "wall_friction=0.1"}), parse_scene(scene_text, "jaw.toml"));
}

TEST(SceneChange, ThatIsNoneIsRefusedWithTheNearestKey) {
    EXPECT_THAT(
        refusal_of({"wall_frictoin=0.3"}),
        AllOf(HasSubstr("--set: "), HasSubstr("did you mean 'wall_friction'?"), Not(HasSubstr("jaw.toml"))));
    EXPECT_THAT(refusal_of({"devic.scale=0.3"}), HasSubstr("did you mean 'device'?"));
    EXPECT_THAT(refusal_of({"device.scle=0.3"}), HasSubstr("did you mean 'scale'?"));
    EXPECT_THAT(refusal_of({"burrs.2.5 mm.edges=4"}), HasSubstr("did you mean '1.5 mm'?"));
    EXPECT_THAT(refusal_of({"name.x=1"}), HasSubstr("'name' is no table"));
    EXPECT_THAT(refusal_of({"wall_friction=2"}),
                HasSubstr("'wall_friction' is 2; it must lie within 0 to 1"));
    EXPECT_THAT(refusal_of({"device..scale=2"}), HasSubstr("is no key"));
    EXPECT_THAT(refusal_of({"wall_friction=" + std::string(33, '[')}), HasSubstr("more than 32 brackets"))
        << "too much of TOML, no text";
    EXPECT_EQ(refusal_of({"name=\"a\" # and more"}), "");
    EXPECT_THROW(parse_scene_change("wall_friction"), std::invalid_argument);
    EXPECT_THROW(parse_scene_change("=3"), std::invalid_argument);
}

TEST(SceneChange, IsNotBlamedForWhatTheFileHasWrong) {
    try {
        parse_scene("name = \"x\"\nbon = 1\n", "jaw.toml", {}, {{{"wall_friction", "0.3"}}, "--set"});
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr("jaw.toml:"));
    }
}

}  // namespace
}  // namespace osteomill
