// The sweep of the stability map as a lab runs it: in parts, killed and taken up again, joined.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr std::chrono::seconds patience{120};

std::string text_of(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

std::size_t lines_in(const std::filesystem::path& file) {
    const std::string text = text_of(file);
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

class StabilitySweep : public ::testing::Test {
  protected:
    void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
        GTEST_SKIP() << "what it runs is run by the unit tests; under a sanitizer it takes minutes";
#endif
    }

    /// A corner of the map: nine cases of a twentieth of a second.
    std::vector<std::string> command(const std::vector<std::string>& more) const {
        std::vector<std::string> all{STUDY,         "stability", "--quick", "--methods",
                                     "interpolate", "--grips",   "firm",    "--milling-rates-hz",
                                     "1000",        "--delays",  "0"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    testing::Finished join(const std::vector<std::string>& parts, const std::string& out) const {
        std::vector<std::string> all{STUDY, "stability", "--out", out, "--merge"};
        all.insert(all.end(), parts.begin(), parts.end());
        return testing::run_program(all, patience);
    }

    std::string folder(const std::string& name) const {
        return (folder_ / name).string();
    }

    void expect_same_results(const std::string& one, const std::string& other) const {
        for (const char* name :
             {"map.csv", "map.json", "errors.csv", "regions_cutting.csv", "pareto_wall.csv",
              "map_cutting.svg", "map_wall.svg", "map_pareto.svg", "map_errors.svg"}) {
            EXPECT_FALSE(text_of(one + '/' + name).empty()) << name;
            EXPECT_EQ(text_of(one + '/' + name), text_of(other + '/' + name)) << name;
        }
    }

    testing::TemporaryFolder folder_;
};

TEST_F(StabilitySweep, PartsJoinToTheBytesOfOneProcess) {
    const auto whole = testing::run_program(command({"--out", folder("whole")}), patience);
    ASSERT_EQ(whole.status, 0) << whole.err;
    EXPECT_THAT(whole.out, HasSubstr("interpolate"));
    EXPECT_THAT(whole.err, HasSubstr("cases 100 %"));
    for (const char* shard : {"1/2", "2/2"}) {
        const auto part = testing::run_program(
            command({"--out", folder("parts"), "--shard", shard, "--jobs", "2"}), patience);
        ASSERT_EQ(part.status, 0) << part.err;
        EXPECT_THAT(part.out, HasSubstr("join the parts with --merge"));
    }
    const auto joined = join({folder("parts")}, folder("joined"));
    ASSERT_EQ(joined.status, 0) << joined.err;
    expect_same_results(folder("whole"), folder("joined"));

    const auto half = join({folder("parts") + "/cases-2-of-2.jsonl"}, folder("half"));
    EXPECT_EQ(half.status, 1);
    EXPECT_THAT(half.err, HasSubstr("missing of 2 parts: 1"));
    std::filesystem::copy(folder("parts"), folder("copy"));
    const auto twice = join({folder("parts"), folder("copy")}, folder("twice"));
    EXPECT_EQ(twice.status, 1);
    EXPECT_THAT(twice.err, HasSubstr("is there twice: in "));
}

TEST_F(StabilitySweep, IsTakenUpAfterAKill) {
    const auto whole = testing::run_program(command({"--out", folder("whole")}), patience);
    ASSERT_EQ(whole.status, 0) << whole.err;
    const std::filesystem::path cases = folder_ / "killed/cases-1-of-1.jsonl";
    {
        testing::ChildProcess killed(command({"--out", folder("killed"), "--jobs", "1"}));
        const auto deadline = std::chrono::steady_clock::now() + patience;
        while (lines_in(cases) < 3 && std::chrono::steady_clock::now() < deadline)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        killed.send_signal(SIGKILL);
        ASSERT_EQ(killed.wait(patience), 128 + SIGKILL) << "it was done before it could be killed";
    }
    // As if the kill had come in the middle of a line.
    std::filesystem::resize_file(cases, std::filesystem::file_size(cases) - 5);
    const std::size_t done = lines_in(cases) - 1;
    const auto other =
        testing::run_program({STUDY, "stability", "--quick", "--out", folder("killed")}, patience);
    EXPECT_EQ(other.status, 1);
    EXPECT_THAT(other.err, HasSubstr("holds cases of another list"));
    EXPECT_EQ(std::count(other.err.begin(), other.err.end(), '\n'), 1) << other.err;

    const auto again = testing::run_program(command({"--out", folder("killed")}), patience);
    ASSERT_EQ(again.status, 0) << again.err;
    EXPECT_THAT(again.out, StartsWith(std::to_string(done) + " of "));
    expect_same_results(folder("whole"), folder("killed"));
    EXPECT_FALSE(std::filesystem::exists(cases)) << "once the results are there, the cases are of no use";
}

TEST_F(StabilitySweep, RunsItsPartsByGnuParallel) {
    if (std::system("parallel --version >/dev/null 2>&1 </dev/null") != 0)
        GTEST_SKIP() << "GNU parallel is not installed";
    std::vector<std::string> all{"/usr/bin/env", "parallel", "--will-cite", "--jobs", "2"};
    for (const std::string& word : command({"--jobs", "1", "--out", folder("parts"), "--shard", "{}/3"}))
        all.push_back(word);
    for (const char* word : {":::", "1", "2", "3"}) all.emplace_back(word);
    const auto ran = testing::run_program(all, patience);
    ASSERT_EQ(ran.status, 0) << ran.err;
    const auto joined = join({folder("parts")}, folder("joined"));
    ASSERT_EQ(joined.status, 0) << joined.err;
    EXPECT_THAT(joined.out, HasSubstr("charts (SVG) are in"));
}

TEST_F(StabilitySweep, SaysWhatIsWrongWithItsOptions) {
    const auto refused = [&](const std::vector<std::string>& options, const std::string& reason) {
        std::vector<std::string> all{STUDY, "stability", "--out", folder("out")};
        all.insert(all.end(), options.begin(), options.end());
        const auto finished = testing::run_program(all, patience);
        EXPECT_EQ(finished.status, 2) << reason;
        EXPECT_THAT(finished.err, HasSubstr(reason));
        EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    };
    refused({"--shard", "3/2"}, "'3/2' is no part I/N with 1 <= I <= N");
    refused({"--methods", "hold,glue"}, "glue");
    refused({"--delays", "7"}, "7");
    refused({"--merge", "a", "--quick"}, "--merge");
}

}  // namespace
}  // namespace osteomill
