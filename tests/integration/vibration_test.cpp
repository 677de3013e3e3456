// Sessions of the server with --vibration beside ones without.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <iostream>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "tests/support/file_text.h"
#include "tests/support/force_log_file.h"
#include "tests/support/spectrum.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using testing::text_of;

struct Session {
    nlohmann::json measured;
    std::string log;
    std::string said;
    std::vector<glm::dvec3> force_n{};  // while it cuts
};

/// From two seconds on the simulated hand is in the bone.
Session run(const std::string& options) {
    const testing::TemporaryFolder folder;
    const std::string command = HAPTIC_SERVER " --clock virtual --duration-s 8 " + options + " --json " +
                                (folder / "a.json").string() + " --log-csv " + (folder / "a.csv").string() +
                                " 2>" + (folder / "err").string() + " </dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << text_of(folder / "err");
    Session session{.measured = nlohmann::json::parse(text_of(folder / "a.json")),
                    .log = text_of(folder / "a.csv"),
                    .said = text_of(folder / "err")};
    for (const testing::ForceLogLine& line : testing::read_force_log(folder / "a.csv"))
        if (line.time_s >= 2.0) session.force_n.push_back(line.force_n);
    return session;
}

/// Mean over the seconds of the log of the largest amplitude between two frequencies.
double amplitude_between(const Session& session, double from_hz, double to_hz) {
    constexpr std::size_t second = 1000;
    double sum_n = 0.0;
    std::size_t seconds = 0;
    for (std::size_t first = 0; first + second <= session.force_n.size(); first += second, ++seconds) {
        const std::span<const glm::dvec3> samples(session.force_n.data() + first, second);
        double largest_n = 0.0;
        for (double hz = from_hz; hz < to_hz; hz += 1.0)
            largest_n = std::max(largest_n, testing::amplitude_at(samples, hz));
        sum_n += largest_n;
    }
    return sum_n / static_cast<double>(seconds);
}

double most_energy_mj(const Session& session) {
    return session.measured.at("energy_to_hand_mj").at("most").get<double>();
}

constexpr double spindle_hz = 10'000.0 / 60.0;

TEST(Vibration, IsALineAtTheSpindlesFrequencyAndNothingElse) {
    for (const std::string grip : {"light", "firm"}) {
        const std::string options = "--scene cube --grip " + grip;
        const Session without = run(options);
        const Session with = run(options + " --vibration");
        std::cout << grip << " grip: amplitude in mN, without and with vibration\n";
        for (double hz = 0.0; hz < 500.0; hz += 50.0)
            std::cout << hz << " to " << hz + 50.0
                      << " Hz: " << 1000.0 * amplitude_between(without, hz + 1.0, hz + 51.0) << "  "
                      << 1000.0 * amplitude_between(with, hz + 1.0, hz + 51.0) << '\n';
        const double line_n = amplitude_between(with, spindle_hz - 2.0, spindle_hz + 2.0);
        // A light hand's cut takes 0.04 mW, and half of that is all that its hum may give.
        EXPECT_GT(line_n, grip == "light" ? 0.08 : 0.4) << grip;
        EXPECT_LT(amplitude_between(without, spindle_hz - 2.0, spindle_hz + 2.0), 0.1 * line_n) << grip;
        EXPECT_LT(amplitude_between(with, 200.0, 500.0),
                  amplitude_between(without, 200.0, 500.0) + 0.05 * line_n)
            << grip << ": nothing is aliased";
        EXPECT_LE(with.measured.at("peak_force_n").get<double>(), 3.3) << "what the arm gives";
        // Whole steps of an encoder are read as energy, too, that a sampled spring gave a light hand.
        EXPECT_LE(most_energy_mj(with), most_energy_mj(without) + (grip == "light" ? 0.3 : 0.01)) << grip;
        std::cout << "energy to the hand, most: " << most_energy_mj(without) << " and "
                  << most_energy_mj(with) << " mJ; peak " << without.measured.at("peak_force_n") << " and "
                  << with.measured.at("peak_force_n") << " N\n";
        for (const auto& [fault, count] : with.measured.at("faults").items())
            EXPECT_EQ(count, without.measured.at("faults").at(fault)) << fault;
    }
}

TEST(Vibration, RepeatsToTheBit) {
    const std::string options = "--scene cube --vibration --grip light";
    const Session first = run(options);
    const Session second = run(options);
    EXPECT_EQ(first.log, second.log);
    EXPECT_EQ(first.measured.at("bone_checksum"), second.measured.at("bone_checksum"));
}

TEST(Vibration, OfBurrsThatTurnTooFastIsNothingAndTheServerSaysSo) {
    const Session without = run("--scene tooth");
    const Session with = run("--scene tooth --vibration");
    EXPECT_EQ(with.log, without.log);
    EXPECT_NE(with.said.find("--vibration: no burr of the scene vibrates at 300 Hz or below"),
              std::string::npos)
        << with.said;
}

}  // namespace
}  // namespace osteomill
