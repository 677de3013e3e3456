#include "studies/stability/map/case_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "tests/support/temporary_folder.h"

namespace osteomill::study::case_file_test {
namespace {

using ::testing::HasSubstr;

const MapSelection few{.quick = true, .methods = {"hold"}, .grips = {MapGrip::light}};

MapOutcome outcome(double seed) {
    return {.resistance_n_s_per_m = seed / 3.0,
            .truth_mean_n = 0.1 * seed,
            .is_stable = true,
            .limit_cycle_n = 1e-300 * seed,
            .injected_mj = -seed,
            .rms_error_n = std::sqrt(seed),
            .mean_error_n = 1e17 * seed,
            .peak_n = seed,
            .largest_jump_n = seed / 7.0,
            .depth_error_mm = seed / 9.0,
            .removed_mm3 = seed / 11.0,
            .max_residual_n = seed / 13.0,
            .fallbacks = seed,
            .energy_faults = 2.0 * seed};
}

class CaseFileTest : public ::testing::Test {
  protected:
    std::string refusal(const MapSelection& selection, const Shard& shard) const {
        try {
            CaseFileWriter writer(file_, selection, map_points(selection), shard);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "taken";
    }

    testing::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "cases.jsonl";
};

TEST_F(CaseFileTest, GivesBackEveryBit) {
    {
        CaseFileWriter writer(file_, few, map_points(few), {2, 3});
        writer.append(4, outcome(1.0));
        writer.append(1, outcome(2.0 / 3.0));
        MapOutcome astray = outcome(3.0);
        astray.peak_n = std::numeric_limits<double>::infinity();
        writer.append(0, astray);
    }
    const CaseFile read = read_case_file(file_);
    EXPECT_EQ(read.shard, (Shard{2, 3}));
    EXPECT_EQ(read.selection, few);
    ASSERT_EQ(read.outcomes.size(), 3U);
    EXPECT_EQ(read.outcomes.at(4), outcome(1.0));
    EXPECT_EQ(read.outcomes.at(1), outcome(2.0 / 3.0));
    EXPECT_TRUE(std::isnan(read.outcomes.at(0).peak_n)) << "JSON knows no infinity";
}

TEST_F(CaseFileTest, IsTakenUpWithoutTheLineThatWasTorn) {
    const auto points = map_points(few);
    {
        CaseFileWriter writer(file_, few, points, {});
        writer.append(0, outcome(1.0));
        writer.append(1, outcome(2.0));
    }
    std::filesystem::resize_file(file_, std::filesystem::file_size(file_) - 20);
    {
        CaseFileWriter writer(file_, few, points, {});
        EXPECT_EQ(writer.done_before().size(), 1U);
        writer.append(1, outcome(2.0));
    }
    EXPECT_EQ(read_case_file(file_).outcomes.at(1), outcome(2.0));
    // A kill at the very start leaves not even the first line.
    std::filesystem::resize_file(file_, 10);
    EXPECT_TRUE(CaseFileWriter(file_, few, points, {}).done_before().empty());
    EXPECT_EQ(read_case_file(file_).selection, few);
}

TEST_F(CaseFileTest, RefusesWhatIsOfAnotherListOrNone) {
    const CaseFileWriter writer(file_, few, map_points(few), {});
    EXPECT_THAT(refusal(few, {}), HasSubstr("another process is writing it"));
    std::filesystem::copy_file(file_, folder_ / "copy.jsonl");
    file_ = folder_ / "copy.jsonl";
    EXPECT_EQ(refusal(few, {}), "taken");
    EXPECT_THAT(refusal({.quick = true}, {}), HasSubstr("copy.jsonl: holds cases of another list"));
    EXPECT_THAT(refusal(few, {1, 2}), HasSubstr("of another list"));
    std::ofstream(file_, std::ios::app) << "{\"case\":1}\n";
    EXPECT_THAT(refusal(few, {}), HasSubstr("copy.jsonl: line 2 is no case"));
    std::ofstream(file_) << "name,age\n";
    EXPECT_THAT(refusal(few, {}), HasSubstr("its first line is not that of a file of cases"));
}

}  // namespace
}  // namespace osteomill::study::case_file_test
