#include "render_client/ui/options.h"

#include <gtest/gtest.h>

#include <vector>

namespace osteomill::options_test {
namespace {

ParsedOptions parsed(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "render_client");
    return parse_options(static_cast<int>(arguments.size()), arguments.data(), "1.2.3");
}

void expect_refused(const std::vector<const char*>& arguments, const std::string& named) {
    const ParsedOptions result = parsed(arguments);
    ASSERT_TRUE(result.no_run.has_value()) << named;
    EXPECT_EQ(result.no_run->exit_code, 2);
    EXPECT_NE(result.no_run->message.find(named), std::string::npos) << result.no_run->message;
    EXPECT_EQ(result.no_run->message.find('\n'), std::string::npos) << result.no_run->message;
}

TEST(Options, WorkWithAServerOnThisMachineByDefault) {
    const ParsedOptions result = parsed({});
    EXPECT_FALSE(result.no_run.has_value());
    EXPECT_EQ(result.options.host, "127.0.0.1");
    EXPECT_EQ(result.options.port, 7010);
    EXPECT_FALSE(result.options.offscreen);
}

TEST(Options, ChooseRendererShadingAndTransferFunctionByName) {
    EXPECT_EQ(parsed({}).options.renderer, RendererChoice::raycast);
    EXPECT_EQ(parsed({}).options.look, ShadingSettings{});
    const ParsedOptions result =
        parsed({"--renderer", "slices", "--shading", "surface-voxels", "--transfer", "tooth"});
    ASSERT_FALSE(result.no_run.has_value()) << result.no_run->message;
    EXPECT_EQ(result.options.renderer, RendererChoice::slices);
    EXPECT_EQ(result.options.look.shading, Shading::surface_voxels);
    ASSERT_TRUE(result.options.look.transfer.has_value());
    EXPECT_EQ(result.options.look.transfer->name, "tooth");
    expect_refused({"--renderer", "rasterise"}, "--renderer: is 'rasterise', not one of raycast, slices");
    expect_refused({"--shading", "flat"}, "surface-voxels");
    expect_refused({"--transfer", "skin"}, "ct-window");
}

TEST(Options, DrawForTwoEyes) {
    EXPECT_EQ(parsed({}).options.stereo, StereoSettings{});
    const ParsedOptions result =
        parsed({"--stereo", "rows", "--interpupillary", "2.5", "--convergence", "30"});
    ASSERT_FALSE(result.no_run.has_value()) << result.no_run->message;
    EXPECT_EQ(result.options.stereo, (StereoSettings{StereoLayout::rows, 2.5, 30.0}));
    expect_refused({"--stereo", "anaglyph"}, "quad-buffer");
    expect_refused({"--stereo", "rows", "--convergence", "0"}, "--convergence: 0 is not within 1 to 10000");
    expect_refused({"--stereo", "rows", "--interpupillary", "nan"}, "--interpupillary");
    expect_refused({"--interpupillary", "60"}, "need --stereo");
    expect_refused({"--offscreen", "--stereo", "quad-buffer"}, "is for a window");
}

TEST(Options, LookThroughAMicroscope) {
    const ParsedOptions plain = parsed({});
    EXPECT_EQ(plain.options.magnification, 1.0);
    EXPECT_FALSE(plain.options.light_field);
    EXPECT_EQ(plain.options.inset, InsetKind::off);
    const ParsedOptions result = parsed({"--magnification", "1.6", "--light-field", "--inset", "axial"});
    ASSERT_FALSE(result.no_run.has_value()) << result.no_run->message;
    EXPECT_EQ(result.options.magnification, 1.6);
    EXPECT_TRUE(result.options.light_field);
    EXPECT_EQ(result.options.inset, InsetKind::axial);
    expect_refused({"--magnification", "3"}, "is '3', not one of 0.4, 0.6, 1, 1.6, 2.5");
    expect_refused({"--inset", "coronal"}, "endoscope");
}

TEST(Options, LightTheBone) {
    EXPECT_TRUE(parsed({}).options.ambient_occlusion);
    EXPECT_FALSE(parsed({"--no-ambient-occlusion"}).options.ambient_occlusion);
    EXPECT_EQ(parsed({}).options.specular, std::nullopt);
    EXPECT_TRUE(parsed({}).options.grain);
    EXPECT_FALSE(parsed({"--no-grain"}).options.grain);
    EXPECT_TRUE(parsed({}).options.neutral_sawn_faces);
    EXPECT_FALSE(parsed({"--no-neutral-sawn-faces"}).options.neutral_sawn_faces);
    EXPECT_EQ(parsed({"--specular", "0.4"}).options.specular, 0.4);
    expect_refused({"--specular", "2"}, "--specular: 2 is not within 0 to 1");
    expect_refused({"--specular", "wet"}, "--specular");
}

TEST(Options, OpenTheBoneByTheSidesThatAreToGo) {
    EXPECT_FALSE(parsed({}).options.cuts.any());
    const ParsedOptions result = parsed({"--cut", "front", "--cut", "left:-2.5"});
    ASSERT_FALSE(result.no_run.has_value()) << result.no_run->message;
    const CutSettings& cuts = result.options.cuts;
    EXPECT_TRUE(cuts[0].is_on);
    EXPECT_EQ(cuts[0].normal, glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_EQ(cuts[0].position_mm, -2.5);
    EXPECT_EQ(cuts[1].normal, glm::dvec3(0.0, -1.0, 0.0));
    EXPECT_EQ(cuts[1].position_mm, 0.0);
    EXPECT_FALSE(cuts[2].is_on);
    for (const char* wrong : {"top", "left:", "left:1mm", "left:nan", ":3"})
        expect_refused({"--cut", wrong}, wrong);
    expect_refused({"--cut", "left", "--cut", "right"}, "already");
}

TEST(Options, TakeEverythingOfAnOffscreenRun) {
    const ParsedOptions result = parsed({"--connect", "[::1]:7011", "--offscreen", "--frames", "12",
                                         "--screenshots", "shots", "--screenshot-every", "3", "--window-size",
                                         "320x200", "--texture-budget-mib", "64", "--json", "out.json"});
    ASSERT_FALSE(result.no_run.has_value()) << result.no_run->message;
    EXPECT_EQ(result.options.host, "::1");
    EXPECT_EQ(result.options.port, 7011);
    EXPECT_EQ(result.options.frames, 12);
    EXPECT_EQ(result.options.screenshots, "shots");
    EXPECT_EQ(result.options.screenshot_every, 3);
    EXPECT_EQ(result.options.window_size_px, glm::ivec2(320, 200));
    EXPECT_EQ(result.options.texture_budget_bytes, std::size_t{64} << 20U);
    EXPECT_EQ(result.options.json, "out.json");
}

TEST(Options, SetTheView) {
    const ParsedOptions result = parsed({"--theme", "light", "--ui-scale", "1.5", "--no-panels"});
    ASSERT_FALSE(result.no_run.has_value()) << result.no_run->message;
    EXPECT_EQ(result.options.theme, ThemeName::light);
    EXPECT_EQ(result.options.ui_scale, 1.5);
    EXPECT_FALSE(result.options.panels);
    EXPECT_EQ(parsed({}).options.theme, std::nullopt) << "as it was left";
    EXPECT_TRUE(parsed({}).options.panels);
    expect_refused({"--theme", "pink"}, "--theme");
    expect_refused({"--ui-scale", "9"}, "--ui-scale");
}

TEST(Options, RefuseInOneLineThatNamesWhatIsWrong) {
    expect_refused({"--connect", "somewhere"}, "somewhere");
    expect_refused({"--connect", "host:70000"}, "host:70000");
    expect_refused({"--window-size", "12"}, "--window-size");
    expect_refused({"--window-size", "0x10"}, "--window-size");
    expect_refused({"--offscreen", "--frames", "0"}, "--frames");
    expect_refused({"--frames", "5"}, "--offscreen");
    expect_refused({"--gpu", "1"}, "--offscreen");
    expect_refused({"--offscreen", "--gpu", "-1"}, "--gpu");
    expect_refused({"--offscreen", "--screenshot-every", "2"}, "--screenshots");
    expect_refused({"--offscreen", "--until-server-ends"}, "--until-server-ends");
    expect_refused({"--no-such-option"}, "--no-such-option");
}

TEST(Options, ShowHelpAndVersionWithoutARun) {
    ASSERT_TRUE(parsed({"--help"}).no_run.has_value());
    EXPECT_EQ(parsed({"--help"}).no_run->exit_code, 0);
    EXPECT_EQ(parsed({"--version"}).no_run->message, "render_client 1.2.3\n");
}

TEST(Options, TakeARecordingInPlaceOfAServer) {
    const ParsedOptions replay = parsed({"--replay", "a.pcap", "--speed", "2.5"});
    ASSERT_FALSE(replay.no_run) << replay.no_run->message;
    EXPECT_EQ(replay.options.replay, "a.pcap");
    EXPECT_EQ(replay.options.speed, 2.5);
    EXPECT_EQ(parsed({"--record", "b.pcap"}).options.record, "b.pcap");
    expect_refused({"--replay", "a.pcap", "--connect", "127.0.0.1:7010"}, "--replay");
    expect_refused({"--replay", "a.pcap", "--record", "b.pcap"}, "--record");
    expect_refused({"--replay", "a.pcap", "--speed", "0"}, "--speed");
    EXPECT_EQ(parsed({"--replay", "a.pcap", "--from-s", "12.5"}).options.from_s, 12.5);
    expect_refused({"--from-s", "12.5"}, "--from-s needs --replay");
    expect_refused({"--replay", "a.pcap", "--from-s", "-1"}, "--from-s");
    EXPECT_EQ(parsed({"--replay", "a.pcap", "--film", "a.mp4"}).options.film, "a.mp4");
    expect_refused({"--film", "a.mp4"}, "--film needs --replay");
    expect_refused({"--replay", "a.pcap", "--film", "a.pcap"}, "--film");
    expect_refused({"--replay", "a.pcap", "--film", "a.mp4", "--screenshots", "a"}, "--screenshots");
    expect_refused({"--speed", "2"}, "--speed");
}

}  // namespace
}  // namespace osteomill::options_test
