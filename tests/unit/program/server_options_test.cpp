#include "haptic_server/program/server_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "simulation/force_models/force_models.h"
#include "tests/support/message_of.h"
#include "tests/support/messages.h"

namespace osteomill {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

CommandLine parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "haptic_server");
    return parse_command_line(static_cast<int>(arguments.size()), arguments.data(), "1.2.3");
}

std::string error_of(const std::vector<const char*>& arguments) {
    return testing::message_of<std::invalid_argument>([&] { parse(arguments); });
}

TEST(ServerOptions, NeedNoneToServeTheToothOnThisMachine) {
    const ServerOptions options = *parse({}).options;
    EXPECT_FALSE(options.scene.name);
    EXPECT_STREQ(options.device.entry->name, "simulated");
    EXPECT_EQ(options.milling.clock, ClockKind::real);
    EXPECT_EQ(name_of(options.milling.coupling), "implicit");
    EXPECT_TRUE(std::isinf(options.milling.duration_s));
    ASSERT_TRUE(options.listen.has_value());
    EXPECT_EQ(options.listen->address, "127.0.0.1");
    EXPECT_EQ(options.listen->port, 7010);
    EXPECT_FALSE(options.outputs.json || options.logs.force || options.outputs.save_bone ||
                 options.scene.bone);
}

TEST(ServerOptions, SetKeysOfTheScene) {
    const ServerOptions options =
        *parse({"--set", "wall_friction=0.3", "--set", "plan.sphere={ radius_mm = 2 }", "--burr", "2 mm",
                "--rpm", "30000"})
             .options;
    ASSERT_EQ(options.scene.changes.changes.size(), 3U);
    EXPECT_EQ(options.scene.changes.changes[0], (SceneChange{"wall_friction", "0.3"}));
    EXPECT_EQ(options.scene.changes.changes[1], (SceneChange{"plan.sphere", "{ radius_mm = 2 }"}));
    EXPECT_EQ(options.scene.changes.changes[2], (SceneChange{"start_burr", "2 mm", true}));
    EXPECT_EQ(options.scene.spindle_rpm, 30'000.0);
    EXPECT_FALSE(parse({}).options->scene.spindle_rpm);
    EXPECT_THAT(error_of({"--set", "wall_friction"}), AllOf(HasSubstr("--set"), HasSubstr("KEY=VALUE")));
    EXPECT_THAT(error_of({"--rpm", "20"}), HasSubstr("--rpm"));
    EXPECT_THAT(error_of({"--bone", "b.nrrd", "--set", "wall_friction=0.3"}), HasSubstr("--scene"));
}

TEST(ServerOptions, DriveAHapticArmInRealTime) {
    const ServerOptions usual = *parse({"--device", "hid"}).options;
    EXPECT_STREQ(usual.device.entry->name, "hid");
    EXPECT_TRUE(usual.device.files_read.empty());
    const auto own = parse({"--device", "hid", "--device-profile", "my.toml"}).options->device;
    ASSERT_EQ(own.files_read.size(), 1U);
    EXPECT_EQ(own.files_read[0].path, "my.toml");
    EXPECT_STREQ(parse({"--device", "spacemouse"}).options->device.entry->name, "spacemouse");
    EXPECT_TRUE(parse({"--list-devices"}).options->device.lists_devices);
    EXPECT_THAT(error_of({"--device", "hid", "--clock", "virtual"}), HasSubstr("--clock real"));
    EXPECT_THAT(error_of({"--device", "hid", "--trajectory", "t.csv"}), HasSubstr("--device simulated"));
    EXPECT_THAT(error_of({"--device-profile", "polhem_v1"}), HasSubstr("--device hid"));
}

TEST(ServerOptions, MeasureAnArmIntoAProfile) {
    EXPECT_FALSE(parse({}).options->measures_into);
    EXPECT_EQ(*parse({"--measure-arm"}).options->measures_into, "measured_arm.toml");
    for (const char* arm : {"hid", "haply", "bridge", "simulated"})
        EXPECT_EQ(
            *parse({"--measure-arm", "--device", arm, "--save-profile", "my.toml"}).options->measures_into,
            "my.toml")
            << arm;
    // Over the profile that it reads, but over no other input.
    const std::vector<const char*> hid{"--measure-arm", "--device", "hid", "--device-profile", "my.toml"};
    const auto with = [&](std::vector<const char*> more) {
        more.insert(more.begin(), hid.begin(), hid.end());
        return more;
    };
    EXPECT_EQ(error_of(with({"--save-profile", "my.toml"})), "");
    EXPECT_THAT(error_of(with({"--save-profile", "t.toml", "--controls", "t.toml"})),
                AllOf(HasSubstr("--save-profile"), HasSubstr("--controls")));
}

TEST(ServerOptions, MeasureNothingThatIsNoHeldArm) {
    const std::vector<std::pair<std::vector<const char*>, const char*>> wrong{
        {{"--save-profile", "my.toml"}, "--save-profile is of no use without --measure-arm"},
        {{"--measure-arm", "--device", "client"},
         "--device client is no arm; take hid, bridge, haply or simulated"},
        {{"--measure-arm", "--device", "spacemouse"}, "--device spacemouse is no arm"},
        {{"--measure-arm", "--grip", "rails"},
         "--measure-arm: a prescribed hand (--grip rails) feels no force"},
        {{"--measure-arm", "--trajectory", "t.csv"}, "leave --trajectory out"},
        {{"--measure-arm", "--save-profile", "my.txt"}, "--save-profile: 'my.txt' must end in .toml"},
        {{"--measure-arm", "--json", "a.json"},
         "--json is of no use with --measure-arm, which runs no session"},
        {{"--measure-arm", "--report", "out"}, "--report is of no use with --measure-arm"},
        {{"--measure-arm", "--wait-for-client"}, "--wait-for-client is of no use with --measure-arm"},
        {{"--measure-arm", "--device", "hid", "--clock", "virtual"}, testing::needs_real_clock}};
    for (const auto& [words, why] : wrong)
        EXPECT_THAT(error_of(words), AllOf(HasSubstr(why), Not(HasSubstr("\n"))));
}

TEST(ServerOptions, PutTheBurrOfATrackedHandWhereTheHandIs) {
    const std::vector<const char*> tracked{"--device", "tracker", "--tracker-registration", "t.toml"};
    const auto with = [&](std::vector<const char*> more) {
        more.insert(more.begin(), tracked.begin(), tracked.end());
        return more;
    };
    const ServerOptions options = *parse(tracked).options;
    EXPECT_STREQ(options.device.entry->name, "tracker");
    EXPECT_EQ(name_of(options.milling.coupling), "hold");
    EXPECT_EQ(options.milling.milling_rate_hz, 1000.0);
    EXPECT_EQ(name_of(parse(with({"--coupling", "implicit"})).options->milling.coupling), "implicit");
    EXPECT_EQ(name_of(parse(with({"--force-model", "morris"})).options->milling.coupling), "hold");
    EXPECT_EQ(error_of(with({"--tracker", "[::1]:20000"})), "");
    EXPECT_THAT(error_of(with({"--tracker", "10.0.0.7:18944"})),
                HasSubstr("ssh -L 18944:localhost:18944 10.0.0.7"));
    EXPECT_THAT(error_of(with({"--tracker", "127.0.0.1:0"})), HasSubstr("port 0"));
    EXPECT_THAT(error_of({"--device", "tracker"}), HasSubstr("--tracker-registration"));
    EXPECT_THAT(error_of({"--tracker-name", "Drill"}), HasSubstr("goes with --device tracker"));
    EXPECT_THAT(error_of(with({"--json", "t.toml"})), HasSubstr("--tracker-registration"));
}

TEST(ServerOptions, LookForHaplysServiceOnThisMachine) {
    const ServerOptions usual = *parse({"--device", "haply"}).options;
    EXPECT_STREQ(usual.device.entry->name, "haply");
    EXPECT_EQ(name_of(usual.milling.coupling), "implicit");
    EXPECT_EQ(error_of({"--device", "haply", "--haply", "[::1]:10002"}), "");
    EXPECT_THAT(error_of({"--device", "haply", "--haply", "10.0.0.7:10001"}),
                HasSubstr("ssh -L 10001:localhost:10001 10.0.0.7"));
    EXPECT_THAT(error_of({"--device", "haply", "--haply", "localhost:0"}), HasSubstr("port 0"));
    EXPECT_THAT(error_of({"--device", "haply", "--haply", "haply"}),
                HasSubstr("--haply: 'haply' has no port"));
    EXPECT_THAT(error_of({"--haply", "localhost:10001"}), HasSubstr("goes with --device haply"));
}

TEST(ServerOptions, MillAtThePublishedRateWithThePublishedCoupling) {
    EXPECT_EQ(parse({}).options->milling.milling_rate_hz, 1000.0);
    EXPECT_EQ(parse({"--coupling", "interpolate"}).options->milling.milling_rate_hz, 100.0);
    EXPECT_EQ(parse({"--coupling", "sample-estimate-interpolate"}).options->milling.milling_rate_hz, 100.0);
    EXPECT_EQ(parse({"--coupling", "hold"}).options->milling.milling_rate_hz, 1000.0);
    EXPECT_EQ(parse({"--coupling=interpolate", "--milling-rate-hz=500"}).options->milling.milling_rate_hz,
              500.0);
}

TEST(ServerOptions, ShakeTheHandpieceOnlyWhereAskedToAndWhereTheModelCuts) {
    EXPECT_FALSE(parse({}).options->milling.vibration);
    EXPECT_TRUE(parse({"--vibration"}).options->milling.vibration);
    EXPECT_TRUE(parse({"--vibration", "--coupling", "hold", "--force-model", "milling-bins"})
                    .options->milling.vibration);
    EXPECT_THAT(error_of({"--vibration", "--force-model", "agus"}),
                AllOf(HasSubstr("--vibration"), HasSubstr("agus"), Not(HasSubstr("\n"))));
}

TEST(ServerOptions, CoupleAForceModelThatHasNoCuttingLawByInterpolatingAtTheHapticRate) {
    for (const char* model : {"point-spring", "petersik", "morris", "agus"}) {
        const MillingSessionOptions session = parse({"--force-model", model}).options->milling;
        EXPECT_EQ(session.force_model, model);
        EXPECT_EQ(name_of(session.coupling), "interpolate") << model;
        EXPECT_EQ(session.milling_rate_hz, 1000.0) << "a wall needs what there is";
        EXPECT_EQ(
            name_of(parse({"--force-model", model, "--coupling", "interpolate"}).options->milling.coupling),
            "interpolate");
        EXPECT_THAT(error_of({"--force-model", model, "--coupling", "implicit"}),
                    AllOf(HasSubstr("--coupling implicit"), HasSubstr(model), HasSubstr("interpolate"),
                          Not(HasSubstr("\n"))));
    }
    EXPECT_EQ(name_of(parse({"--force-model", "milling-bins"}).options->milling.coupling), "implicit");
}

TEST(ServerOptions, TakeACouplingWithADamper) {
    EXPECT_EQ(name_of(parse({"--coupling", "interpolate+damper"}).options->milling.coupling),
              "interpolate+damper");
    EXPECT_THAT(error_of({"--coupling", "implicit+damper"}), HasSubstr("+damper or +passivity"));
}

TEST(ServerOptions, ServeNobodyOnTheVirtualClockUnlessAsked) {
    EXPECT_FALSE(parse({"--clock", "virtual"}).options->listen.has_value());
    EXPECT_TRUE(parse({"--clock", "virtual", "--listen", "127.0.0.1:0"}).options->listen.has_value());
    EXPECT_FALSE(parse({"--listen", "none"}).options->listen.has_value());
}

TEST(ServerOptions, WaitForAClientOnlyWhereOneMayComeAndTimeIsReal) {
    EXPECT_FALSE(parse({}).options->waits_for_client);
    EXPECT_TRUE(parse({"--wait-for-client"}).options->waits_for_client);
    EXPECT_TRUE(parse({"--wait-for-client", "--device", "client"}).options->waits_for_client);
    const std::vector<std::pair<std::vector<const char*>, const char*>> wrong{
        {{"--wait-for-client", "--listen", "none"}, "--wait-for-client: needs --clock real and --listen"},
        {{"--wait-for-client", "--clock", "virtual"}, "--wait-for-client: needs --clock real and --listen"},
        {{"--wait-for-client", "--clock", "virtual", "--listen", "127.0.0.1:0"},
         "--wait-for-client: needs --clock real"},
        {{"--wait-for-client=soon"}, "soon"},
        {{"--wait-for-client", "20"}, "20"}};
    for (const auto& [words, why] : wrong)
        EXPECT_THAT(error_of(words), AllOf(HasSubstr(why), Not(HasSubstr("\n")))) << words.back();
}

TEST(ServerOptions, RefuseToListenToOtherMachinesWithoutTls) {
    EXPECT_THAT(error_of({"--listen", "0.0.0.0:7010"}), AllOf(HasSubstr("--listen"), HasSubstr("TLS")));
}

TEST(ServerOptions, NameTheOptionAndTheChoicesInOneLine) {
    EXPECT_THAT(error_of({"--coupling", "magic"}), AllOf(HasSubstr("--coupling"), HasSubstr("'magic'"),
                                                         HasSubstr("implicit, hold, interpolate")));
    EXPECT_THAT(error_of({"--force-model", "x"}), AllOf(HasSubstr("--force-model"), HasSubstr("milling")));
    EXPECT_THAT(error_of({"--clock", "sun"}), HasSubstr("real, virtual"));
    EXPECT_THAT(error_of({"--device", "hid7"}), HasSubstr("simulated, client"));
    EXPECT_THAT(error_of({"--grip", "iron"}), HasSubstr("light, firm"));
    EXPECT_THAT(error_of({"--nonsense"}), HasSubstr("--nonsense"));
    EXPECT_THAT(error_of({"--milling-rate-hz", "5"}), HasSubstr("--milling-rate-hz"));
    EXPECT_THAT(error_of({"--milling-rate-hz", "nan"}), HasSubstr("nan is not within 25 to 10000"));
    EXPECT_THAT(error_of({"--milling-rate-hz", "fast"}), HasSubstr("--milling-rate-hz"));
    EXPECT_EQ(error_of({"--duration-s", "-1"}), "--duration-s: -1 is not above 0; see --help");
    EXPECT_THAT(error_of({"--duration-s", "nan"}), HasSubstr("is not above 0"));
    EXPECT_THAT(error_of({"--haptic-cpu", "-1"}), HasSubstr("-1 is not 0 or more"));
    EXPECT_THAT(error_of({"--save-bone", "bone.stl"}), AllOf(HasSubstr("--save-bone"), HasSubstr(".nrrd")));
    EXPECT_THAT(error_of({"--listen", "here"}), Not(HasSubstr("\n")));
}

TEST(ServerOptions, RefuseCombinationsThatMakeNoSense) {
    EXPECT_THAT(error_of({"--device", "client", "--clock", "virtual"}), HasSubstr("--device client"));
    EXPECT_THAT(error_of({"--device", "client", "--listen", "none"}), HasSubstr("--listen"));
    EXPECT_THAT(error_of({"--device", "client", "--trajectory", "x.csv"}), HasSubstr("--trajectory"));
}

TEST(ServerOptions, PrintHelpAndVersionAndAreDone) {
    const CommandLine help = parse({"--help"});
    EXPECT_FALSE(help.options.has_value());
    for (const char* option :
         {"--scene", "--bone", "--device", "--listen", "--tls-cert", "--tls-key", "--tls-ca",
          "--insecure-network", "--coupling", "--force-model", "--milling-rate-hz", "--clock", "--duration-s",
          "--trajectory", "--save-bone", "--json", "--log-csv"}) {
        EXPECT_THAT(help.text, HasSubstr(option));
    }
    for (const ForceModelEntry& model : force_models())
        EXPECT_THAT(help.text, AllOf(HasSubstr(model.name), HasSubstr(model.text)));
    EXPECT_EQ(parse({"--version"}).text, "haptic_server 1.2.3\n");
}

}  // namespace
}  // namespace osteomill
