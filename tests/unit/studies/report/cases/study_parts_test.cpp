#include "analysis/output/cases/study_parts.h"

#include <gmock/gmock.h>

#include <stdexcept>

#include "tests/support/temporary_folder.h"

namespace osteomill::study::study_parts_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(StudyParts, KeepWhatIsRunApartFromWhereAndHow) {
    StudyParts parts;
    const std::vector<std::string> words{"force",  "--quick", "--out=x", "--jobs", "2",
                                         "--seed", "3",       "--shard", "1/2",    "--out", "y"};
    EXPECT_EQ(command_line(words, parts), words);
    EXPECT_THAT(parts.command, ElementsAre("force", "--quick", "--seed", "3"));
    EXPECT_FALSE(parts.joined);
}

TEST(StudyParts, MergeTakesTheOptionsFromTheParts) {
    const testing::TemporaryFolder folder;
    {
        PartFileWriter writer(part_file_of({}, folder.path()),
                              {.command = {"force", "--random", "9"}, .program = fingerprint_of_program()});
    }
    const std::string place = folder.path().string();
    StudyParts parts;
    EXPECT_THAT(command_line({"force", "--merge", place, "--out", "x"}, parts),
                ElementsAre("force", "--random", "9", "--merge", place, "--out", "x"));
    EXPECT_TRUE(parts.joined);
    const auto refusal = [&](const std::vector<std::string>& words) -> std::string {
        try {
            StudyParts none;
            command_line(words, none);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "taken";
    };
    EXPECT_THAT(refusal({"force", "--quick", "--merge", place}), HasSubstr("leave --quick out"));
    EXPECT_THAT(refusal({"polishing", "--merge", place}), HasSubstr("the parts are of the study 'force'"));
}

}  // namespace
}  // namespace osteomill::study::study_parts_test
