#include "devices/measured/measured_profile.h"

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
using ::testing::HasSubstr;

const MeasuredArm measured{.calm_n_per_mm = 4.2,
                           .damping_n_s_per_mm = 0.0055,
                           .step_mm = 0.055,
                           .noise_mm = 0.0012,
                           .delay_s = 0.0013,
                           .moving_mass_kg = 0.145,
                           .friction_n = 0.26};

void expect_same(const MeasuredArm& read) {
    EXPECT_DOUBLE_EQ(read.calm_n_per_mm, 4.2);
    EXPECT_DOUBLE_EQ(read.damping_n_s_per_mm, 0.0055);
    EXPECT_DOUBLE_EQ(read.step_mm, 0.055);
    EXPECT_DOUBLE_EQ(read.noise_mm, 0.0012);
    EXPECT_DOUBLE_EQ(*read.delay_s, 0.0013);
    EXPECT_DOUBLE_EQ(*read.moving_mass_kg, 0.145);
    EXPECT_DOUBLE_EQ(*read.friction_n, 0.26);
}

struct File {
    testing::TemporaryFolder folder;
    std::filesystem::path path = folder.path() / "arm.toml";

    explicit File(const std::string& text) { std::ofstream(path) << text; }
    std::string error() const {
        return testing::message_of<SceneError>([&] { load_measured_profile(path); });
    }
};

TEST(MeasuredProfile, IsReadAsItWasWritten) {
    const File file(measured_profile_text({.arm = R"(an "arm")", .measured = measured}));
    const MeasuredProfile read = load_measured_profile(file.path);
    EXPECT_EQ(read.arm, R"(an "arm")");
    expect_same(read.measured);
    const std::string odd = R"(of C:\arms, "the left")";
    EXPECT_EQ(load_measured_profile(File(measured_profile_text({.arm = odd, .measured = measured})).path).arm,
              odd);
}

TEST(MeasuredProfile, LeavesOutWhatCouldNotBeMeasured) {
    const File file(
        measured_profile_text({.arm = "a", .measured = {.calm_n_per_mm = 1.0, .damping_n_s_per_mm = 0.004}}));
    const MeasuredArm read = load_measured_profile(file.path).measured;
    EXPECT_FALSE(read.delay_s || read.moving_mass_kg || read.friction_n);
}

TEST(MeasuredProfile, JoinsTheProfileOfAnArmOverUsb) {
    const std::string shipped = arm_profile_text("polhem_v1");
    EXPECT_FALSE(parse_arm_profile(shipped, "p.toml").measured);
    const std::string once = with_measured_table(shipped, measured);
    EXPECT_TRUE(once.starts_with(shipped.substr(0, shipped.size() - 1))) << "no line of it changes";
    const ArmProfile profile = parse_arm_profile(once, "p.toml");
    ASSERT_TRUE(profile.measured);
    expect_same(*profile.measured);
    EXPECT_EQ(profile.joints[1].body_m, parse_arm_profile(shipped, "p.toml").joints[1].body_m);
    MeasuredArm other = measured;
    other.calm_n_per_mm = 5.0;
    const std::string twice = with_measured_table(once, other);
    EXPECT_EQ(parse_arm_profile(twice, "p.toml").measured->calm_n_per_mm, 5.0);
    EXPECT_EQ(with_measured_table(twice, measured), once) << "the old table is replaced";
}

TEST(MeasuredProfile, SaysWhatIsWrong) {
    EXPECT_THAT(File("name = \"a\"\n").error(), AllOf(HasSubstr("arm.toml"), HasSubstr("measured")));
    EXPECT_THAT(File("name = \"a\"\n[measured]\ncalm_n_per_m = 1\n").error(), HasSubstr("arm.toml:3"));
    EXPECT_THAT(
        File(
            "name = \"a\"\n[measured]\ncalm_n_per_m = 900\ndamping_n_s_per_m = 4\nstep_mm = 0\nnoise_mm = 0\n"
            "stpe = 1\n")
            .error(),
        HasSubstr("stpe"));
    EXPECT_THAT(File(arm_profile_text("polhem_v1")).error(), HasSubstr("measured"));
}

}  // namespace
}  // namespace osteomill
