#include "analysis/output/study_run.h"

#include <gmock/gmock.h>

#include <atomic>
#include <sstream>
#include <stdexcept>

#include "tests/support/temporary_folder.h"

namespace osteomill::study::study_run_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<int> numbers{1, 2, 3, 4, 5, 6, 7};

class StudyRunTest : public ::testing::Test {
  protected:
    /// A study of squares and of one more case; empty where it was a part.
    std::vector<double> study(StudyParts parts, const std::string& out, int fails_at = 0) {
        const std::filesystem::path folder = folder_ / out;
        const StudySurroundings surroundings{.said = said_, .progress = progress_, .parts = std::move(parts)};
        StudyRun run(folder, surroundings);
        const auto squares = run.plan(
            numbers, [](int n) { return "number " + std::to_string(n); },
            [&](int n) {
                if (n == fails_at) throw std::invalid_argument("too hard");
                ++times_run_;
                return 1.0 / (n * n);
            });
        const auto last = run.plan(
            std::vector{1}, [](int) { return "one more"; }, [](int) { return 1.5; });
        if (!run.perform()) return {};
        std::vector<double> found = squares.outcomes();
        found.push_back(last.outcomes().at(0));
        return found;
    }

    std::size_t files_in(const std::string& out) const {
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator(folder_ / out), {}));
    }

    testing::TemporaryFolder folder_;
    std::ostringstream said_;
    std::ostringstream progress_;
    std::atomic<int> times_run_{0};
};

TEST_F(StudyRunTest, GivesOutcomesInOrderAndLeavesNothingBehind) {
    EXPECT_THAT(study({.jobs = 3}, "whole"),
                ElementsAre(1.0 / 1, 1.0 / 4, 1.0 / 9, 1.0 / 16, 1.0 / 25, 1.0 / 36, 1.0 / 49, 1.5));
    EXPECT_EQ(files_in("whole"), 0U);
    EXPECT_THAT(progress_.str(), HasSubstr("cases 100 %\n"));
}

TEST_F(StudyRunTest, PartsJoinToTheWhole) {
    for (std::size_t number = 1; number <= 3; ++number) {
        EXPECT_THAT(study({.shard = {number, 3}}, "parts"), ElementsAre());
    }
    EXPECT_THAT(said_.str(), HasSubstr("part 3 of 3 is in "));
    EXPECT_EQ(times_run_, 7);
    StudyParts joined;
    joined.joined.emplace(std::vector{folder_ / "parts"});
    EXPECT_EQ(study(joined, "joined"), study({}, "whole"));
    EXPECT_EQ(times_run_, 14) << "joining runs nothing";
}

TEST_F(StudyRunTest, GoesOnAfterTheCaseThatFailed) {
    EXPECT_THROW(
        {
            try {
                study({}, "out", 5);
            } catch (const std::runtime_error& error) {
                EXPECT_STREQ(error.what(), "case 'number 5': too hard");
                throw;
            }
        },
        std::runtime_error);
    EXPECT_EQ(files_in("out"), 1U) << "what was done before is kept";
    const int before = times_run_;
    EXPECT_EQ(study({}, "out").size(), 8U);
    EXPECT_EQ(times_run_, 7) << before << " of them before the failure, none twice";
}

}  // namespace
}  // namespace osteomill::study::study_run_test
