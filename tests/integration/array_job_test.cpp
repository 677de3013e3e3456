// A study as a job array under a real Slurm: a task killed and submitted again, the parts joined.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/file_text.h"
#include "tests/support/slurm_cluster.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::text_of;

/// A corner of the map: nine cases of a twentieth of a second.
const std::vector<std::string> study{"stability", "--quick", "--methods",          "interpolate",
                                     "--grips",   "firm",    "--milling-rates-hz", "1000",
                                     "--delays",  "0"};

class ArrayJob : public ::testing::Test {
  protected:
    testing::Finished run(std::vector<std::string> words) const {
        words.insert(words.begin(), STUDY);
        return testing::run_program(words);
    }

    /// The study, except in task 2: there a limit of its files kills it in the middle of a line, after its
    /// first case, and then the task sleeps until it is killed, too.
    std::string study_that_stops_in_task_2() const {
        const std::filesystem::path script = folder_ / "study.sh";
        std::ofstream(script) << "#!/bin/bash\n"
                                 "[ \"$SLURM_ARRAY_TASK_ID\" = 2 ] || exec " STUDY
                                 " \"$@\"\n"
                                 "(ulimit -c 0; ulimit -f 1; exec " STUDY
                                 " \"$@\")\n"
                                 "touch "
                              << (folder_ / "stopped").string() << "\nexec sleep infinity\n";
        std::filesystem::permissions(script, std::filesystem::perms::owner_all);
        return script.string();
    }

    std::string submit(const testing::SlurmCluster& cluster, std::vector<std::string> variables,
                       const std::string& array) const {
        variables.push_back("OUT=" + parts_);
        std::vector<std::string> words{"--array=" + array, "--output=" + (folder_ / "%a.log").string(),
                                       OSTEOMILL_SOURCES "/scripts/array.sbatch"};
        words.insert(words.end(), study.begin(), study.end());
        return cluster.submit(variables, words);
    }

    std::string refusal_to_join(std::vector<std::string> parts) const {
        parts.insert(parts.begin(), {"stability", "--out", (folder_ / "refused").string(), "--merge"});
        const testing::Finished finished = run(parts);
        EXPECT_EQ(finished.status, 1);
        EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
        return finished.err;
    }

    testing::TemporaryFolder folder_;
    std::string parts_ = (folder_ / "parts").string();
};

TEST_F(ArrayJob, OfWhichATaskWasKilledJoinsToTheBytesOfOneProcess) {
    if (const std::string why_not = testing::SlurmCluster::why_not(); !why_not.empty())
        GTEST_SKIP() << why_not;
    const testing::SlurmCluster cluster(folder_ / "slurm");
    const std::string job = submit(cluster, {"STUDY=" + study_that_stops_in_task_2()}, "1-4");
    const auto others_are_done = [&] {
        return std::filesystem::exists(folder_ / "stopped") && cluster.tasks(job).size() == 1;
    };
    ASSERT_TRUE(testing::eventually(others_are_done));
    EXPECT_THAT(cluster.tasks(job), ElementsAre(job + "_2"));
    cluster.cancel(job + "_2");
    ASSERT_TRUE(testing::eventually([&] { return cluster.tasks(job).empty(); }));
    EXPECT_THAT(refusal_to_join({parts_}), HasSubstr("cases-2-of-4.jsonl: has done 1 of its 2 cases"));

    const std::string again = submit(cluster, {"STUDY=" STUDY, "PARTS=4"}, "2");
    ASSERT_TRUE(testing::eventually([&] { return cluster.tasks(again).empty(); }));
    EXPECT_THAT(text_of(folder_ / "2.log"), HasSubstr("1 of 2 cases are done in "))
        << "it goes on where it was";

    const testing::Finished joined =
        run({"stability", "--merge", parts_, "--out", (folder_ / "joined").string()});
    ASSERT_EQ(joined.status, 0) << joined.err;
    std::vector<std::string> one_process = study;
    one_process.insert(one_process.end(), {"--out", (folder_ / "whole").string()});
    ASSERT_EQ(run(one_process).status, 0);
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "whole")) {
        ++files;
        EXPECT_EQ(text_of(folder_ / "joined" / entry.path().filename()), text_of(entry.path()))
            << entry.path();
    }
    EXPECT_GT(files, 8U) << "tables, JSON and charts";

    std::filesystem::copy_file(parts_ + "/cases-1-of-4.jsonl", folder_ / "copy.jsonl");
    EXPECT_THAT(refusal_to_join({parts_, (folder_ / "copy.jsonl").string()}),
                HasSubstr("part 1 is there twice: in "));
    std::filesystem::remove(parts_ + "/cases-3-of-4.jsonl");
    EXPECT_THAT(refusal_to_join({parts_}), HasSubstr("missing of 4 parts: 3"));
}

}  // namespace
}  // namespace osteomill
