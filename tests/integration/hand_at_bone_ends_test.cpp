// Ordinary motions of a hand at the end of bone, at which the default coupling once failed. Each is a scene
// and a motion in tests/data/haptics, played by the real server on its virtual clock.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/force_log_file.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::hand_at_bone_ends_test {
namespace {

/// The force that a hand felt.
struct Felt {
    double peak_n = 0.0;
    double largest_jump_n = 0.0;
    /// Longest time with more than 0.3 N and no bone removed.
    int stuck_ms = 0;
    double removed_mm3 = 0.0;
    nlohmann::json measured;
};

Felt felt_in(const std::vector<testing::ForceLogLine>& log) {
    Felt felt;
    int stuck_ms = 0;
    for (std::size_t i = 1; i < log.size(); ++i) {
        const double force_n = glm::length(log[i].force_n);
        felt.peak_n = std::max(felt.peak_n, force_n);
        felt.largest_jump_n =
            std::max(felt.largest_jump_n, glm::distance(log[i].force_n, log[i - 1].force_n));
        // At 1 kHz a shallow cut may leave every voxel's level alone for a tick or two.
        const bool cuts = log[i].removed_mm3 > log[i >= 4 ? i - 4 : 0].removed_mm3;
        stuck_ms = force_n > 0.3 && !cuts ? stuck_ms + 1 : 0;
        felt.stuck_ms = std::max(felt.stuck_ms, stuck_ms);
    }
    felt.removed_mm3 = log.empty() ? 0.0 : log.back().removed_mm3;
    return felt;
}

class HandAtBoneEnds : public ::testing::Test {
  protected:
    Felt play(const std::string& scene, const std::string& motion) const {
        const std::string data = OSTEOMILL_TEST_DATA "/haptics/";
        const testing::Finished run =
            testing::run_program({HAPTIC_SERVER, "--clock", "virtual", "--scene", data + scene + ".toml",
                                  "--trajectory", data + motion + ".csv", "--log-csv", folder_ / "force.csv",
                                  "--json", folder_ / "measured.json"});
        EXPECT_EQ(run.status, 0) << run.err;
        said_ = run.err;
        log_ = testing::read_force_log(folder_ / "force.csv");
        Felt felt = felt_in(log_);
        felt.measured = nlohmann::json::parse(std::ifstream(folder_ / "measured.json"));
        const nlohmann::json& solve = felt.measured.at("solve");
        EXPECT_LT(solve.at("max_residual_n").get<double>(), 1e-3) << "every tick ends in balance";
        EXPECT_EQ(felt.measured.at("faults").at("energy_to_hand"), 0);
        return felt;
    }

    mutable std::vector<testing::ForceLogLine> log_;
    mutable std::string said_;  // by the server, on standard error
    testing::TemporaryFolder folder_;
};

TEST_F(HandAtBoneEnds, ABurrThatBreaksThroughTheBraincaseDoesNotJam) {
    // It was held with 2.6 N for 4 s, cutting nothing. A rigid burr meets 0.6 N.
    const Felt felt = play("jam", "jam");
    EXPECT_LE(felt.stuck_ms, 50);
    EXPECT_LT(felt.peak_n, 1.0);
    EXPECT_LT(felt.largest_jump_n, 0.3);
    EXPECT_LT(felt.measured.at("energy_to_hand_mj").at("most").get<double>(), 5.0);
    EXPECT_GT(felt.removed_mm3, 40.0) << "and is through";
}

TEST_F(HandAtBoneEnds, APassAlongAnEdgeDoesNotDriveTheHand) {
    // It gave the hand 185 mJ, with 3.3 N and jumps of 0.71 N. A rigid burr gives 54 mJ, 5 more would be a
    // fault.
    const Felt felt = play("edge", "edge");
    EXPECT_LT(felt.measured.at("energy_to_hand_mj").at("most").get<double>(), 15.0);
    EXPECT_LT(felt.peak_n, 1.2);
    EXPECT_LT(felt.largest_jump_n, 0.3);
    EXPECT_LE(felt.stuck_ms, 50);
    EXPECT_GT(felt.removed_mm3, 20.0);
}

TEST_F(HandAtBoneEnds, ALargerBurrIsNotPutIntoTheHoleOfASmallerOne) {
    // 5 mm came to be in the hole of 1.5 mm: 3.3 N, and the hand was thrown 8 mm.
    const Felt felt = play("change", "change");
    EXPECT_LT(felt.peak_n, 1.0);
    EXPECT_LT(felt.largest_jump_n, 0.3);
    ASSERT_FALSE(log_.empty());
    for (const testing::ForceLogLine& line : log_) {
        if (line.time_s < 4.9) continue;  // 4.81 s is when it is requested
        ASSERT_LT(glm::distance(line.burr_mm, log_.back().burr_mm), 0.2) << line.time_s;
        ASSERT_LT(glm::length(line.force_n), 0.1) << line.time_s;
    }
    EXPECT_THAT(said_, ::testing::HasSubstr("changed in the air"));
}

TEST_F(HandAtBoneEnds, ABurrThatTurnsIsNotChanged) {
    // 60 mm^3 vanished in one step.
    const Felt felt = play("change", "change_on");
    EXPECT_LT(felt.removed_mm3, 6.0) << "the hole of 1.5 mm";
    EXPECT_LT(felt.peak_n, 1.0);
    EXPECT_THAT(said_, ::testing::HasSubstr("let go of the pedal"));
}

TEST_F(HandAtBoneEnds, AShankTiltedInAHoleThrowsNoHandOutOfIt) {
    // 25 holes and tilts that the study makes.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "the optimised program's; under a sanitizer it takes minutes";
#endif
    for (const std::string method : {"implicit", "virtual-coupling"}) {
        const testing::Finished run =
            testing::run_program({STUDY, "stability", "--sites", "--quick", "--only", "in a hole of 2.",
                                  "--methods", method, "--out", folder_ / method},
                                 std::chrono::seconds(900));
        ASSERT_EQ(run.status, 0) << run.err;
        const auto found = nlohmann::json::parse(std::ifstream(folder_ / (method + "/sites.json")));
        const auto& holes = found.at("kinds").at("tilted in a hole");
        EXPECT_EQ(holes.at("cases"), 25);
        EXPECT_LT(holes.at("most_energy_mj").get<double>(), 5.0) << method;
        EXPECT_EQ(holes.at("faults"), 0) << method;
    }
}

}  // namespace
}  // namespace osteomill::hand_at_bone_ends_test
