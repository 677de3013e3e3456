#include "render_client/ui/run_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace osteomill::run_json_test {
namespace {

TEST(Report, HasTheKeysThatOthersReadByName) {
    RenderReport report;
    for (const double ms : {4.0, 8.0, 6.0}) report.frame_times.add(ms);
    report.gl_renderer = "llvmpipe";
    report.bone_checksum = 0xabcdef;
    const auto json = nlohmann::json::parse(to_json(report));
    EXPECT_EQ(json.at("frames"), 3);
    EXPECT_EQ(json.at("frame_ms").at("p50"), 6.0);
    EXPECT_DOUBLE_EQ(json.at("frame_ms").at("p99").get<double>(), 7.96);
    EXPECT_EQ(json.at("frame_ms").at("max"), 8.0);
    EXPECT_EQ(json.at("gl_renderer"), "llvmpipe");
    EXPECT_EQ(json.at("bone_checksum"), "0000000000abcdef");
    EXPECT_TRUE(json.at("bone_textures").is_null());
}

TEST(Report, SaysHowTheBoneIsHeld) {
    RenderReport report;
    report.textures = TexturePlan{BoneLayout::atlas, 2, 3U << 20};
    const auto textures = nlohmann::json::parse(to_json(report)).at("bone_textures");
    EXPECT_EQ(textures.at("layout"), "atlas");
    EXPECT_EQ(textures.at("coarsening"), 2);
    EXPECT_EQ(textures.at("mib"), 3.0);
}

TEST(Report, SurvivesAStatusThatIsNoText) {
    RenderReport report;
    report.link_status = "bad \xff byte";
    EXPECT_TRUE(nlohmann::json::accept(to_json(report)));
}

TEST(Report, NamesTheFileThatItCannotWrite) {
    try {
        write_report({}, "/no/such/folder/report.json");
        FAIL() << "wrote into a folder that is not there";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("/no/such/folder/report.json"), std::string::npos);
    }
}

TEST(FrameTimes, GivesPercentilesOfFramesInAnyOrder) {
    FrameTimes times;
    for (int ms = 101; ms >= 1; --ms) times.add(ms);
    EXPECT_EQ(times.percentile_ms(0.5), 51.0);
    EXPECT_EQ(times.percentile_ms(0.99), 100.0);
    EXPECT_EQ(times.percentile_ms(1.0), 101.0);
}

TEST(FrameTimes, IsZeroWithoutFrames) {
    EXPECT_EQ(FrameTimes().percentile_ms(0.5), 0.0);
}

}  // namespace
}  // namespace osteomill::run_json_test
