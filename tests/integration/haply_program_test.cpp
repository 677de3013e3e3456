// haptic_server and Haply's service, and failures of the service and its arm.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/eventually.h"
#include "tests/support/haply_service.h"
#include "tests/support/logged_removal.h"
#include "tests/support/messages.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::testing {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

using Command = std::vector<std::string>;

/// A hand that goes to and fro by 2 mm over the start, slowly down by 3.6 mm and up again, each time 1 mm
/// deeper, with the pedal down: a spring of 0.5 N/mm to an arm of 50 g. Bone pushes it back.
class Hand {
  public:
    HaplyService::Devices operator()(double time_s, const glm::dvec3& force_n) {
        // Delays of the machine are not made up for: the hand stands still.
        const double span_s = std::clamp(time_s - time_s_, 0.0, 0.01);
        time_s_ = time_s;
        const double phase = time_s - std::floor(time_s);
        const double round = std::floor(time_s / 8.0);
        const double into_s = time_s - 8.0 * round;
        const double down_mm =
            round + (into_s < 6.0 ? 0.6 * into_s : std::max(-1.0 - round, 3.6 - 5.0 * (into_s - 6.0)));
        const glm::dvec3 target_mm(phase < 0.5 ? 8.0 * phase - 2.0 : 6.0 - 8.0 * phase, 0.0, -down_mm);
        for (int i = 0; i < 20; ++i) {
            const double step_s = span_s / 20.0;
            const glm::dvec3 all_n = 0.5 * (target_mm - position_mm_) + force_n - 0.005 * velocity_mm_per_s_;
            velocity_mm_per_s_ += 1000.0 * all_n / 0.05 * step_s;
            position_mm_ += velocity_mm_per_s_ * step_s;
        }
        HaplyService::Devices devices = still();
        devices.position_m += 0.001 * position_mm_;
        devices.velocity_m_per_s = 0.001 * velocity_mm_per_s_;
        devices.a = into_s > 0.5;
        return devices;
    }
    /// The devices at the server's start position, the grip pointing down.
    static HaplyService::Devices still() {
        HaplyService::Devices devices;
        devices.position_m = {0.0, -0.12, 0.15};
        devices.turn = glm::angleAxis(glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0));
        return devices;
    }

  private:
    double time_s_ = 0.0;
    glm::dvec3 position_mm_{0.0};
    glm::dvec3 velocity_mm_per_s_{0.0};
};

class HaplyPrograms : public ::testing::Test {
  protected:
    HaplyPrograms() { service_.set(Hand::still()); }
    std::string file(const std::string& name) const { return (folder_ / name).string(); }
    Command server(const std::string& seconds) const {
        return {HAPTIC_SERVER,
                "--device",
                "haply",
                "--haply",
                "127.0.0.1:" + std::to_string(service_.port()),
                "--scene",
                "cube",
                "--listen",
                "none",
                "--duration-s",
                seconds,
                "--json",
                file("run.json")};
    }
    nlohmann::json measured() const {
        std::ifstream in(file("run.json"));
        return nlohmann::json::parse(in);
    }
    double removed_mm3() const { return measured().at("removed_mm3").at("total").get<double>(); }
    bool feels(double least_n) {
        return eventually([&] { return service_.force_n() && glm::length(*service_.force_n()) > least_n; });
    }
    bool feels_nothing() {
        return eventually([&] { return *service_.force_n() == glm::dvec3(0.0); });
    }

    HaplyService service_;
    TemporaryFolder folder_;
};

TEST_F(HaplyPrograms, AnArmMillsAndFeels) {
    ChildProcess running(server("600"));
    ASSERT_TRUE(running.line_after("waiting for an Inverse3 of the Haply service at 127.0.0.1:"));
    ASSERT_TRUE(running.line_after("Haply Inverse3 is there: "));
    std::this_thread::sleep_for(500ms);
    service_.set(Hand());
    EXPECT_TRUE(has_removed(running, 1.0)) << running.err();
    running.send_signal(SIGINT);
    ASSERT_EQ(running.wait(), 0) << running.err();
    EXPECT_EQ(*service_.force_n(), glm::dvec3(0.0)) << "at its end";
    EXPECT_GT(service_.largest_force_n(), 0.2);
    RecordProperty("largest_jump_n", std::to_string(service_.largest_jump_n()));
    EXPECT_GT(removed_mm3(), 1.0);
    EXPECT_EQ(measured().at("settings").at("device"), "haply");
    EXPECT_EQ(service_.odd_messages(), 0);
}

// While bone is touched, once each way; then the hand is lifted, and feels again.
TEST_F(HaplyPrograms, WhateverBefallsTheServiceTurnsAllOffAndTheArmComesBack) {
    const auto silence = [this] { service_.set(HaplyService::Mood::silent); };
    const auto garbage = [this] { service_.set(HaplyService::Mood::garbage); };
    const auto death = [this] { service_.kill(); };
    const auto unplugging = [this] {
        HaplyService::Devices none = Hand::still();
        none.has_arm = false;
        service_.set([none](double, const glm::dvec3&) { return none; });
    };
    const auto recovery = [this](bool is_dead) {
        service_.set(HaplyService::Mood::answers);
        service_.set(Hand());  // from the air
        if (is_dead) service_.live();
    };
    ChildProcess running(server("600"));
    ASSERT_TRUE(running.line_after("Haply Inverse3 is there: "));
    const std::vector<std::pair<std::function<void()>, const char*>> faults{
        {silence, "Haply's service is connected, and silent"},
        {garbage, "what Haply's service says is damaged"},
        {death, "does not answer: is it running"},
        {unplugging, "the Inverse3 that there was is not there any more"}};
    service_.set(Hand());
    for (std::size_t i = 0; i < faults.size(); ++i) {
        ASSERT_TRUE(feels(0.2)) << i << ": " << running.err();
        const bool is_dead = i == 2;
        faults[i].first();
        EXPECT_TRUE(is_dead || feels_nothing()) << i;
        ASSERT_TRUE(has_logged(running, device_lost, static_cast<int>(i) + 1)) << i << ": " << running.err();
        ASSERT_TRUE(has_logged(running, faults[i].second, 1)) << i << ": " << running.err();
        recovery(is_dead);
    }
    ASSERT_TRUE(feels(0.2)) << running.err();
    running.send_signal(SIGINT);
    ASSERT_EQ(running.wait(), 0) << running.err();
    EXPECT_EQ(*service_.force_n(), glm::dvec3(0.0)) << "at its end";
    EXPECT_LT(service_.largest_jump_n(), 0.5);
    RecordProperty("largest_jump_n", std::to_string(service_.largest_jump_n()));
}

TEST_F(HaplyPrograms, WaitsForTheArmAndStopsOnASignal) {
    HaplyService::Devices none = Hand::still();
    none.has_arm = false;
    service_.set(none);
    ChildProcess running(server("5"));
    ASSERT_TRUE(running.line_after("Haply's service is there, and no Inverse3"));
    running.send_signal(SIGINT);
    EXPECT_EQ(running.wait(), 0) << running.err();
}

TEST_F(HaplyPrograms, SaysInOneLineWhatIsWrong) {
    for (const auto& [more, words] :
         {std::pair(Command{"--device", "haply", "--haply", "192.168.7.10:10001"},
                    "ssh -L 10001:localhost:10001 192.168.7.10"),
          std::pair(Command{"--device", "haply", "--haply", "here"}, "--haply: 'here' has no port"),
          std::pair(Command{"--device", "haply", "--clock", "virtual"}, needs_real_clock),
          std::pair(Command{"--haply", "127.0.0.1:10001"}, "--haply: goes with --device haply")}) {
        Command command{HAPTIC_SERVER, "--listen", "none"};
        command.insert(command.end(), more.begin(), more.end());
        const Finished run = run_program(command);
        EXPECT_EQ(run.status, 2) << words;
        EXPECT_THAT(run.err, HasSubstr(words));
        EXPECT_EQ(count(run.err, "\n"), 1) << run.err;
    }
}

}  // namespace
}  // namespace osteomill::testing
