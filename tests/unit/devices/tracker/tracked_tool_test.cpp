#include "devices/tracker/tracked_tool.h"

#include <gmock/gmock.h>

#include <chrono>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "tests/support/latched_pedal.h"
#include "tests/support/tracker_server.h"

namespace osteomill {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using testing::TrackerServer;

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A tool that hears `server`, and the loop that reads it.
class TrackedHand : public ::testing::Test {
  protected:
    void begin(const std::string& pedal = "Pedal", const std::string& name = "Drill") {
        tool.emplace(
            TrackerReceiver::Parts{.server = {.port = static_cast<std::uint16_t>(server.port())},
                                   .name = name,
                                   .pedal = {},
                                   .now_s = seconds},
            TrackedHandpiece{
                .burr_centre_mm = {0.0, 0.0, 100.0}, .spindle_axis = {0.0, 0.0, -1.0}, .pedal = pedal},
            ToolPose{.position_mm = {1.0, 2.0, 3.0}});
        tool->start();
    }
    /// Sends at 100 Hz and reads at 1 kHz, by the session's own clock, until `done(state)`, for 30 s at most.
    template <typename Done>
    bool run(Done&& done, const std::string& pedal = "", bool sends = true) {
        const double until_s = seconds() + 30.0;
        for (; seconds() < until_s; ++ticks) {
            now_s += 0.001;
            if (sends && ticks % 10 == 0) {
                if (!pedal.empty()) server.send("Pedal", pedal);
                server.send("Drill", position_mm, turn, 1000.0 + clock_rate * now_s);
            }
            std::this_thread::sleep_for(300us);
            state = tool->read(now_s);
            state.pedal.is_down = pedal_latch.reads(state, now_s);
            if (done(state)) return true;
        }
        return false;
    }

    TrackerServer server;
    std::optional<TrackedTool> tool;
    testing::LatchedPedal pedal_latch;
    glm::dvec3 position_mm{10.0, 20.0, 30.0};
    glm::dquat turn = glm::angleAxis(std::numbers::pi / 2.0, glm::dvec3(1.0, 0.0, 0.0));  // z to -y
    double now_s = 0.0;
    double clock_rate = 1.0;  // the tracker's relative to ours
    int ticks = 0;
    DeviceState state;
};

TEST_F(TrackedHand, PutsTheBurrWhereTheMarkerSays) {
    begin();
    state = tool->read(0.0);
    EXPECT_FALSE(state.connected);
    EXPECT_EQ(state.position_mm, glm::dvec3(1.0, 2.0, 3.0)) << "nothing is known yet";
    ASSERT_TRUE(server.accept());
    ASSERT_TRUE(run([](const DeviceState& seen) { return seen.connected; }));
    EXPECT_LT(glm::distance(state.position_mm, glm::dvec3(10.0, -80.0, 30.0)), 1e-3);
    EXPECT_LT(glm::distance(state.spindle_axis, glm::dvec3(0.0, 1.0, 0.0)), 1e-6);
    EXPECT_FALSE(state.pedal.is_down);
    EXPECT_STREQ(tool->notice(), "");
    EXPECT_FALSE(tool->limits().gives_force);
}

TEST_F(TrackedHand, HasAPedalThatExpires) {
    begin();
    ASSERT_TRUE(server.accept());
    ASSERT_TRUE(
        run([](const DeviceState& seen) { return seen.connected && seen.pedal.said_s > 0.0; }, "off"));
    ASSERT_TRUE(run([](const DeviceState& seen) { return seen.pedal.is_down; }, "on"));
    ASSERT_TRUE(run([](const DeviceState& seen) { return !seen.pedal.is_down; }, "off"));
    ASSERT_TRUE(run([](const DeviceState& seen) { return seen.pedal.is_down; }, "on"));
    const double silent_s = now_s;
    ASSERT_TRUE(run([](const DeviceState& seen) { return !seen.pedal.is_down; }));
    EXPECT_TRUE(state.connected);
    EXPECT_LE(now_s - silent_s, Permission::by_message_s + 0.05);
    const double on_s = now_s;
    run([&](const DeviceState& seen) { return seen.pedal.is_down || now_s > on_s + 0.5; }, "on");
    EXPECT_FALSE(state.pedal.is_down) << "silence is no release";
    const double off_s = now_s;
    run([&](const DeviceState&) { return now_s > off_s + 0.2; }, "off");
    ASSERT_TRUE(run([](const DeviceState& seen) { return seen.pedal.is_down; }, "on"));
}

TEST_F(TrackedHand, IsLostInSilenceAndComesBack) {
    begin("");
    ASSERT_TRUE(server.accept());
    ASSERT_TRUE(run([](const DeviceState& seen) { return seen.pedal.is_down; }))
        << "a pedal that is always down";
    const double silent_s = now_s;
    ASSERT_TRUE(run([](const DeviceState& seen) { return !seen.connected; }, "", false));
    EXPECT_LE(now_s - silent_s, SampledMotion::most_silence_s + 0.05);
    EXPECT_FALSE(state.pedal.is_down);
    ASSERT_TRUE(run([](const DeviceState& seen) { return seen.connected; }));
    EXPECT_FALSE(state.pedal.is_down) << "up for a moment, so that a spindle that was locked can be freed";
    ASSERT_TRUE(run([](const DeviceState& seen) { return seen.pedal.is_down; }));
}

TEST_F(TrackedHand, ConnectsAnewAfterGarbageAndAServerThatWent) {
    begin();
    ASSERT_TRUE(server.accept());
    ASSERT_TRUE(run([](const DeviceState& seen) { return seen.connected; }));
    const std::string garbage(500, '?');
    server.send_bytes(garbage.data(), static_cast<int>(garbage.size()));
    ASSERT_TRUE(run([](const DeviceState& seen) { return !seen.connected; }, "", false));
    EXPECT_THAT(tool->notice(), HasSubstr("no OpenIGTLink"));
    server.hang_up();
    ASSERT_TRUE(server.accept());
    ASSERT_TRUE(run([](const DeviceState& seen) { return seen.connected; }));
    server.hang_up();
    ASSERT_TRUE(run(
        [&](const DeviceState& seen) {
            return !seen.connected && std::string(tool->notice()).find("closed") != std::string::npos;
        },
        "", false));
    ASSERT_TRUE(server.accept());
    ASSERT_TRUE(run([](const DeviceState& seen) { return seen.connected; }));
}

TEST_F(TrackedHand, IsLostAndSaysSoWhileTheTrackersClockIsNotOurs) {
    begin();
    ASSERT_TRUE(server.accept());
    ASSERT_TRUE(run([](const DeviceState& seen) { return seen.connected; }));
    for (const auto& [rate, said] : {std::pair(2.0, "runs faster"), std::pair(0.5, "runs slower")}) {
        clock_rate = rate;
        const char* const words = said;  // clang 14 takes no part of a pair into a lambda
        ASSERT_TRUE(run([&](const DeviceState& seen) {
            return !seen.connected && std::string(tool->notice()).find(words) != std::string::npos;
        })) << rate;
    }
}

TEST_F(TrackedHand, SaysWhyNothingComes) {
    begin("Pedal", "Probe");
    ASSERT_TRUE(server.accept());
    ASSERT_TRUE(run([&](const DeviceState&) {
        return std::string(tool->notice()).find("of other names") != std::string::npos;
    }));
    EXPECT_FALSE(state.connected);
    tool->stop();
    tool->stop();
}

}  // namespace
}  // namespace osteomill
