// haptic_server and a tracker: the library's own server, which sends motions as trackers do.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/logged_removal.h"
#include "tests/support/messages.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tracker_server.h"

namespace osteomill::testing {
namespace {

using ::testing::HasSubstr;

using Command = std::vector<std::string>;

/// The burr's place in the patient, and whether the pedal is down.
struct Moment {
    glm::dvec3 burr_mm{0.0};
    bool pedal = false;
};
using Motion = std::function<Moment(double time_s)>;

/// How a tracker's samples come.
struct Sending {
    double rate_hz = 100.0;
    double jitter_s = 0.0;
    double lost = 0.0;
};

class TrackerPrograms : public ::testing::Test {
  protected:
    TrackerPrograms() {
        std::ofstream out(file("tracker.toml"));
        out << "[tool]\nburr_centre_mm = [" << centre_mm.x << ", " << centre_mm.y << ", " << centre_mm.z
            << "]\nspindle_axis = [0, 0, 1]\n[pedal]\nstring = 'Pedal'\n";
        out.precision(12);
        for (const glm::dvec3& point_mm : {glm::dvec3(0.0), glm::dvec3(80.0, 0.0, 5.0),
                                           glm::dvec3(10.0, 70.0, 0.0), glm::dvec3(-20.0, 5.0, 60.0)}) {
            const glm::dvec3 seen_mm = in_tracker(point_mm);
            out << "[[points]]\ntracker_mm = [" << seen_mm.x << ", " << seen_mm.y << ", " << seen_mm.z
                << "]\npatient_mm = [" << point_mm.x << ", " << point_mm.y << ", " << point_mm.z << "]\n";
        }
    }
    std::string file(const std::string& name) const { return (folder_ / name).string(); }
    glm::dvec3 in_tracker(const glm::dvec3& patient_mm) const {
        return tracker_turn * patient_mm + tracker_mm;
    }

    Command server(const std::string& scene = "cube") {
        return {HAPTIC_SERVER,
                "--device",
                "tracker",
                "--tracker",
                "127.0.0.1:" + std::to_string(tracker_.port()),
                "--tracker-registration",
                file("tracker.toml"),
                "--tracker-name",
                "Drill",
                "--scene",
                scene,
                "--listen",
                "none",
                "--json",
                file("run.json")};
    }
    nlohmann::json measured() const {
        std::ifstream in(file("run.json"));
        return nlohmann::json::parse(in);
    }
    double removed_mm3() const { return measured().at("removed_mm3").at("total").get<double>(); }
    void end(ChildProcess& running) const {
        running.send_signal(SIGINT);
        ASSERT_EQ(running.wait(), 0) << running.err();
    }
    /// Whether everybody had the processor when it was due. If the loop misses its deadlines or samples come
    /// late in a row, the force goes off until the burr is out of the bone, and less is milled.
    bool was_in_time() const {
        return worst_lateness_s_ < 0.01 && measured().at("faults").at("overrun") == 0 &&
               measured().at("faults").at("model_stalled") == 0;
    }
    /// Tries it until a session was in time. On a machine that has too much to do for any, the test is
    /// skipped.
    void in_a_session_in_time(const std::function<void()>& session, const std::function<void()>& expect) {
        constexpr int attempts = 5;
        for (int i = 0; i < attempts; ++i) {
            worst_lateness_s_ = 0.0;
            session();
            if (HasFatalFailure()) return;
            if (was_in_time()) return expect();
        }
        GTEST_SKIP() << "the machine is too busy for a tracker: no session of " << attempts << " was in time";
    }
    /// The handpiece leans and turns while it moves, and takes the marker along.
    void send(const Moment& moment, double time_s) {
        const glm::dquat in_patient =
            glm::angleAxis(0.3 * std::sin(2.0 * time_s), glm::dvec3(0.6, 0.8, 0.0)) *
            glm::angleAxis(time_s, glm::dvec3(0.0, 0.0, 1.0));
        const glm::dquat turn = tracker_turn * in_patient;
        tracker_.send("Pointer", glm::dvec3(0.0), turn, 1.7e9 + time_s);
        tracker_.send("Drill", in_tracker(moment.burr_mm) - turn * centre_mm, turn, 1.7e9 + time_s);
        tracker_.send("Pedal", moment.pedal ? "1" : "0");
    }
    /// Samples in order, each late by its share of the jitter.
    void play(const Motion& motion, double duration_s, const Sending& how) {
        std::mt19937 random(9);
        std::uniform_real_distribution<double> share(0.0, 1.0);
        const auto began = std::chrono::steady_clock::now();
        for (int i = 0; i / how.rate_hz < duration_s; ++i) {
            const double time_s = i / how.rate_hz;
            const auto due =
                began + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                            std::chrono::duration<double>(time_s + how.jitter_s * share(random)));
            std::this_thread::sleep_until(due);
            const std::chrono::duration<double> late = std::chrono::steady_clock::now() - due;
            worst_lateness_s_ = std::max(worst_lateness_s_, late.count());
            if (share(random) >= how.lost) send(motion(time_s), time_s);
        }
    }

    const glm::dquat tracker_turn = glm::normalize(glm::dquat(0.4, -0.2, 0.7, 0.5));
    const glm::dvec3 tracker_mm{120.0, -340.0, -1250.0};
    const glm::dvec3 centre_mm{3.0, -7.0, -140.0};
    TrackerServer tracker_;
    TemporaryFolder folder_;
    double worst_lateness_s_ = 0.0;
};

/// A second in the air, down by 1 mm into the cube (its top is z = 0, the burr's radius 2.5 mm), 20 mm along,
/// up.
Moment groove(double time_s) {
    const double down_s = std::clamp(time_s - 1.0, 0.0, 0.5);
    const double along_s = std::clamp(time_s - 1.7, 0.0, 2.0);
    const double up_s = std::clamp(time_s - 3.9, 0.0, 0.5);
    return {{-10.0 + 10.0 * along_s, 0.0, 5.0 - 7.0 * down_s + 7.0 * up_s}, time_s > 0.5};
}
constexpr double groove_s = 4.8;

/// A segment of the circle times the way, and a cap at its ends.
double groove_mm3() {
    constexpr double r = 2.5, h = 1.0;
    const double segment = r * r * std::acos((r - h) / r) - (r - h) * std::sqrt(2.0 * r * h - h * h);
    return 20.0 * segment + std::numbers::pi * h * h * (3.0 * r - h) / 3.0;
}

TEST_F(TrackerPrograms, MillsTheSweptVolumeAtAnyRateAndJitter) {
    for (const Sending& how : {Sending{20.0}, Sending{60.0, 0.02, 0.05}, Sending{500.0, 0.03}}) {
        const auto session = [&] {
            ChildProcess running(server());
            ASSERT_TRUE(running.line_after("registered by 4 points: residual 0.00 mm")) << running.err();
            ASSERT_TRUE(tracker_.accept());
            play(groove, groove_s, how);
            end(running);
            tracker_.hang_up();
        };
        in_a_session_in_time(session, [&] {
            RecordProperty(std::to_string(static_cast<int>(how.rate_hz)) + "_hz_error_percent",
                           std::to_string(100.0 * (removed_mm3() / groove_mm3() - 1.0)));
            EXPECT_NEAR(removed_mm3(), groove_mm3(), 0.01 * groove_mm3()) << how.rate_hz << " Hz";
        });
    }
}

TEST_F(TrackerPrograms, StopsTheSpindleWhenTheTrackerIsSilentAndGoesOn) {
    const auto session = [&] {
        ChildProcess running(server());
        ASSERT_TRUE(tracker_.accept());
        play(groove, 2.7, {});  // half of it
        EXPECT_TRUE(has_logged(running, device_lost)) << running.err();
        tracker_.hang_up();
        ASSERT_TRUE(tracker_.accept()) << "it comes again by itself";
        play([](double) { return Moment{{0.0, 0.0, 5.0}, false}; }, 1.0, {});
        end(running);
        tracker_.hang_up();
    };
    in_a_session_in_time(session, [&] {
        EXPECT_LT(removed_mm3(), 0.55 * groove_mm3());
        EXPECT_GT(removed_mm3(), 0.4 * groove_mm3());
    });
}

TEST_F(TrackerPrograms, SaysInOneLineWhatIsWrong) {
    std::ofstream(file("line.toml"))
        << "[tool]\nburr_centre_mm=[0,0,1]\nspindle_axis=[0,0,1]\n[pedal]\nalways=true\n"
           "[[points]]\ntracker_mm=[0,0,0]\npatient_mm=[0,0,0]\n"
           "[[points]]\ntracker_mm=[9,0,0]\npatient_mm=[9,0,0]\n"
           "[[points]]\ntracker_mm=[5,0,0]\npatient_mm=[5,0,0]\n";
    const std::string good = file("tracker.toml");
    for (const auto& [more, status, words] :
         {std::tuple(Command{}, 2, "needs --tracker-registration"),
          std::tuple(Command{"--tracker-registration", good, "--tracker", "192.168.7.10:18944"}, 2,
                     "ssh -L 18944:localhost:18944 192.168.7.10"),
          std::tuple(Command{"--tracker-registration", good, "--tracker", "here"}, 2,
                     "--tracker: 'here' has no port"),
          std::tuple(Command{"--tracker-registration", good, "--tracker-name", std::string(21, 'x')}, 2,
                     "at most 20 characters"),
          std::tuple(Command{"--tracker-registration", good, "--clock", "virtual"}, 2, needs_real_clock),
          std::tuple(Command{"--tracker-registration", "/nowhere.toml"}, 1, "/nowhere.toml"),
          std::tuple(Command{"--tracker-registration", file("line.toml")}, 1,
                     "the points lie on one line")}) {
        Command command{HAPTIC_SERVER, "--listen", "none", "--device", "tracker"};
        command.insert(command.end(), more.begin(), more.end());
        const Finished run = run_program(command);
        EXPECT_EQ(run.status, status) << words;
        EXPECT_THAT(run.err, HasSubstr(words));
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
    const Finished other = run_program({HAPTIC_SERVER, "--tracker-registration", good});
    EXPECT_EQ(other.status, 2);
    EXPECT_THAT(other.err, HasSubstr("--tracker-registration: goes with --device tracker"));
}

}  // namespace
}  // namespace osteomill::testing
