#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "common/scene/scene_file.h"
#include "devices/hid/arm_profile.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string shipped_text() {
    return std::string(shipped_profiles().front().toml);
}

/// The shipped WoodenHaptics with one text in the place of another.
std::string changed(const std::string& from, const std::string& to) {
    std::string text = shipped_text();
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

std::string error_of(const std::string& toml) {
    return testing::message_of<SceneError>([&] { parse_arm_profile(toml, "arm.toml"); });
}

TEST(ProfileFile, ShipsThePublishedArms) {
    EXPECT_THAT(shipped_profile_names(), ElementsAre("woodenhaptics_v2015", "polhem_v1", "aluhaptics_v2"));
    for (const std::string& name : shipped_profile_names()) EXPECT_EQ(load_arm_profile(name).name, name);
    const ArmProfile wooden = load_arm_profile("woodenhaptics_v2015");
    EXPECT_EQ(wooden.usb, (HidIdentity{0x1234, 0x0006, 0xFFAB, 0x0200}));
    EXPECT_EQ(wooden.joints[0].body_m, 0.160);
    EXPECT_EQ(wooden.lengths_m, glm::dvec3(0.080, 0.205, 0.245));
    EXPECT_THAT(wooden.home_counts, ElementsAre(0, 0, 6000));
    EXPECT_EQ(wooden.max_force_n, 5.0);
    EXPECT_FALSE(wooden.stylus);
    EXPECT_TRUE(load_arm_profile("polhem_v1").stylus);
    EXPECT_EQ(load_arm_profile("aluhaptics_v2").calibration, CalibrationMethod::at_power_up);
}

TEST(ProfileFile, TakesALabsOwnArm) {
    const testing::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "my_arm.toml";
    std::ofstream(file) << changed("capstan_m = 0.010", "capstan_m = 0.012");
    EXPECT_EQ(load_arm_profile(file.string()).joints[0].capstan_m, 0.012);
}

TEST(ProfileFile, SaysWhatIsWrongWhereAndWhatWouldBeRight) {
    EXPECT_THAT(
        error_of(changed("max_force_n = 5.0", "max_forc_n = 5.0")),
        AllOf(HasSubstr("arm.toml:"), HasSubstr("'max_force_n' is missing"), HasSubstr("'max_forc_n'")));
    EXPECT_THAT(error_of(changed("direction = 1", "direction = 0")),
                HasSubstr("'direction' must be 1 or -1"));
    EXPECT_THAT(error_of(changed("capstan_m = 0.010", "capstan_m = 10.0")),
                HasSubstr("'capstan_m' is 10; it must lie within 0.001 to 1"));
    EXPECT_THAT(error_of(changed("counts = [0, 0, 6000]", "counts = [0, 0, 60000]")),
                HasSubstr("'counts' must be three whole numbers"));
    EXPECT_THAT(error_of(changed("method = \"switch\"", "method = \"swich\"")),
                HasSubstr("choose one of: switch"));
    EXPECT_THAT(error_of(changed("max_current_a = 1.999", "max_current_a = 20")),
                HasSubstr("within 0.01 to 3"));
    EXPECT_THAT(error_of(changed("[[joints]]", "[[jonts]]")), HasSubstr("there are 2 [[joints]]"));
    EXPECT_THAT(error_of(changed("name =", "colour = 1\nname =")), HasSubstr("unknown key 'colour'"));
    EXPECT_THAT(error_of("name = "), HasSubstr("arm.toml:1"));
}

TEST(ProfileFile, NamesTheShippedOnesWhereItKnowsNoSuchName) {
    try {
        load_arm_profile("polhem");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("did you mean polhem_v1"), HasSubstr("aluhaptics_v2")));
    }
    EXPECT_THROW(load_arm_profile("nowhere/arm.toml"), std::runtime_error);
}

}  // namespace
}  // namespace osteomill
