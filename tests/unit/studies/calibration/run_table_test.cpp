#include "analysis/calibration/run_table.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace osteomill::study {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

const std::string header =
    "run,material,diameter_mm,edges,turns,rpm,feed_mm_per_s,depth_mm,tilt_deg,tilt_direction_deg,"
    "force_feed_n,force_across_n,force_up_n,spread_feed_n,spread_across_n,spread_up_n";
const std::string line = "a,bone,4,8,clockwise,20000,6,0.5,30,90,-1,2,3,0.1,0.2,0.3";

class RunTable : public ::testing::Test {
  protected:
    std::vector<MeasuredRun> read(const std::string& text) const {
        std::ofstream(file_) << text;
        return read_runs(file_);
    }

    void expect_refused(const std::string& text, const std::string& where, const std::string& what) const {
        EXPECT_THAT([&] { read(text); },
                    ThrowsMessage<std::runtime_error>(
                        AllOf(HasSubstr("runs.csv" + where + ": "), HasSubstr(what), Not(HasSubstr("\n")))))
            << text;
    }

    /// The good line with one value replaced.
    std::string with(const std::string& value, const std::string& by) const {
        std::string changed = line;
        changed.replace(changed.find(value), value.size(), by);
        return header + "\n" + changed + "\n";
    }

    testing::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "runs.csv";
};

TEST_F(RunTable, SaysHowARunWasCutAndWhatWasFelt) {
    const auto runs = read("# a lab\r\n" + header + ",previous_groove_mm_higher\r\n\r\n" + line +
                           ",\r\n b , bone,4,8,counter-clockwise,20000,6,0.5,0,0,-1,2,3,1e-1,0.2,0.3,0.25");
    ASSERT_EQ(runs.size(), 2u);
    EXPECT_EQ(runs[0].name, "a");
    EXPECT_EQ(runs[0].material, "bone");
    EXPECT_EQ(runs[0].setting.turns, SpindleSense::clockwise);
    EXPECT_EQ(runs[0].setting.tilt_deg, 30.0);
    EXPECT_EQ(runs[0].setting.tilt_direction_deg, 90.0);
    EXPECT_FALSE(runs[0].setting.previous_groove_mm_higher.has_value());
    EXPECT_EQ(runs[0].force_n, glm::dvec3(-1.0, 2.0, 3.0));
    EXPECT_EQ(runs[1].name, "b");
    EXPECT_EQ(runs[1].setting.turns, SpindleSense::counter_clockwise);
    EXPECT_EQ(runs[1].setting.previous_groove_mm_higher, 0.25);
    EXPECT_EQ(runs[1].spread_n, glm::dvec3(0.1, 0.2, 0.3));
}

TEST_F(RunTable, ReadsWhatItAskedToBeFilledIn) {
    std::string table = table_to_fill_in({{.depth_mm = 0.3}, {.diameter_mm = 2.0, .rpm = 1234.5}}, "enamel");
    expect_refused(table, ":2", "force_feed_n is ''; it must be a number");
    for (std::size_t at = 0; (at = table.find(",,,,,,", at)) != std::string::npos;)
        table.replace(at, 6, ",1,2,3,4,5,6");
    const auto runs = read(table);
    ASSERT_EQ(runs.size(), 2u);
    EXPECT_EQ(runs[1].setting.rpm, 1234.5);
    EXPECT_EQ(runs[1].material, "enamel");
}

TEST_F(RunTable, RefusesWhatIsWrongInOneLine) {
    expect_refused("", "", "holds no run");
    expect_refused(header + "\n", "", "holds no run");
    expect_refused(header + ",colour\n" + line + ",red\n", ":1", "unknown column 'colour'");
    expect_refused(header + ",rpm\n" + line + ",1\n", ":1", "column 'rpm' is there twice");
    expect_refused(header.substr(0, header.rfind(',')) + "\n", ":1", "column 'spread_up_n' is missing");
    expect_refused(header + "\n" + line + "\n" + line.substr(0, 20) + "\n", ":3",
                   "values; there must be 16, one for each column");
    expect_refused(with("0.2,0.3", "0.2,0.3,9"), ":2", "17 values; there must be 16");
    expect_refused(with(",-1,", ",nan,"), ":2", "force_feed_n is 'nan'; it must be a number");
    expect_refused(with(",-1,", ",inf,"), ":2", "force_feed_n is 'inf'");
    expect_refused(with(",-1,", ",1.2.3,"), ":2", "force_feed_n is '1.2.3'");
    expect_refused(with("0.2,0.3", "0,0.3"), ":2", "spread_across_n is '0'; it must be a number above 0");
    expect_refused(with("clockwise", "left"), ":2",
                   "turns is 'left'; it must be clockwise or counter-clockwise");
    expect_refused(with(",0.5,", ",2.5,"), ":2",
                   "depth_mm is '2.5'; it must be a number above 0, at most the burr's radius");
    expect_refused(with(",8,", ",8.5,"), ":2", "edges is '8.5'; it must be a whole number");
    expect_refused(with("bone", ""), ":2", "material is ''; it must be a text");
    expect_refused(header + "\n" + line + "\n" + line + "\n", ":3", "run is 'a'; it must be a name that no");
    EXPECT_THAT([&] { read_runs(folder_ / "gone.csv"); },
                ThrowsMessage<std::runtime_error>(HasSubstr("gone.csv: cannot be read")));
}

}  // namespace
}  // namespace osteomill::study
