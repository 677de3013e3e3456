// How a session begins: what is shown before the first tick, and a burr that starts inside the bone. The real
// server.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/recording/playhead.h"
#include "tests/support/block_file.h"
#include "tests/support/child_process.h"
#include "tests/support/force_log_file.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::testing {
namespace {

using namespace std::chrono_literals;
using Command = std::vector<std::string>;

class SessionStart : public ::testing::Test {
  protected:
    std::string file(const std::string& name) const { return (folder_ / name).string(); }
    nlohmann::json json(const std::string& name) const {
        std::ifstream in(file(name));
        return nlohmann::json::parse(in);
    }

    TemporaryFolder folder_;
};

TEST_F(SessionStart, ShowsTheStartPoseBeforeTheFirstTick) {
    // Far from the origin of the patient's axes, with another burr than the first.
    write_block(file("block.nrrd"));
    std::ofstream(file("scene.toml")) << "name = \"far\"\nstart_burr = \"2 mm\"\n"
                                         "[bone]\nfile = \"block.nrrd\"\nthreshold_hu = 300.0\n"
                                         "[[burrs]]\nname = \"1 mm\"\ndiameter_mm = 1.0\n"
                                         "[[burrs]]\nname = \"2 mm\"\ndiameter_mm = 2.0\n"
                                         "[start_pose]\nposition_mm = [40.0, 30.0, 20.0]\n"
                                         "spindle_axis = [0.0, 0.0, 1.0]\n"
                                         "[trajectory]\nmotion = \"hold\"\n";
    for (int attempt = 0; attempt < 5; ++attempt) {
        const std::string recording = file("a" + std::to_string(attempt) + ".pcap");
        const Finished session = run_program({HAPTIC_SERVER, "--scene", file("scene.toml"), "--duration-s",
                                              "0.3", "--listen", "none", "--record", recording});
        ASSERT_EQ(session.status, 0) << session.err;
        Playhead playhead(recording);
        while (!playhead.tool())
            ASSERT_NE(playhead.step(std::numeric_limits<double>::infinity()), Playhead::Step::end);
        const ToolState& first = *playhead.tool();
        EXPECT_LT(glm::distance(first.burr_position_mm, {40.0, 30.0, 20.0}), 0.5);
        EXPECT_LT(glm::distance(first.hand_position_mm, {40.0, 30.0, 20.0}), 0.5);
        EXPECT_EQ(first.burr, 1U);
        EXPECT_EQ(first.fault, "");
    }
}

TEST_F(SessionStart, InsideTheBoneIsWithoutForceUntilTheBurrHasBeenLiftedOut) {
    write_block(file("block.nrrd"));
    // The block's top is at z = 2.2 mm. In it with the pedal down, out, and back onto it.
    std::ofstream(file("motion.csv")) << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n"
                                         "0.0,0,0,0,0,0,1,1\n"
                                         "0.5,0.5,0,0,0,0,1,1\n"
                                         "0.6,0.5,0,0,0,0,1,0\n"
                                         "1.2,0.5,0,6,0,0,1,0\n"
                                         "1.8,0.5,0,6,0,0,1,0\n"
                                         "2.6,0.5,0,2,0,0,1,0\n";
    for (const std::string model : {"milling", "point-spring", "agus"}) {
        const Finished session = run_program(
            {HAPTIC_SERVER, "--bone", file("block.nrrd"), "--trajectory", file("motion.csv"), "--clock",
             "virtual", "--force-model", model, "--json", file("out.json"), "--log-csv", file("force.csv")});
        ASSERT_EQ(session.status, 0) << session.err;
        const auto ticks = read_force_log(file("force.csv"));
        ASSERT_GT(ticks.size(), 2500U);
        constexpr int in_bone = 6;  // of Fault
        bool has_come_back = false;
        for (const ForceLogLine& tick : ticks) {
            if (tick.time_s < 0.7) {
                ASSERT_EQ(tick.force_n, glm::dvec3(0.0)) << model << " at " << tick.time_s << " s";
                ASSERT_FALSE(tick.spindle_on) << model << " at " << tick.time_s << " s";
                ASSERT_EQ(tick.fault, tick.time_s < 0.0005 ? 0 : in_bone) << model << " at " << tick.time_s;
            }
            has_come_back = has_come_back || tick.fault == 0;
        }
        EXPECT_TRUE(has_come_back);
        EXPECT_EQ(json("out.json").at("removed_mm3").at("total"), 0.0) << model;
        EXPECT_GT(ticks.back().force_n.z, 0.05) << model << ": the wall is felt from outside";
    }
}

}  // namespace
}  // namespace osteomill::testing
