#include "analysis/output/cases/joined_parts.h"

#include <gmock/gmock.h>

#include <stdexcept>

#include "tests/support/temporary_folder.h"

namespace osteomill::study::joined_parts_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::vector<std::string> names{"a", "b", "c", "d", "e"};

class JoinedPartsTest : public ::testing::Test {
  protected:
    std::filesystem::path write(const Shard& shard, PartHeader header = {}, std::size_t left_out = 99) const {
        header.shard = shard;
        header.cases = fingerprint_of(names);
        if (header.program.empty()) header.program = fingerprint_of_program();
        const auto file = part_file_of(shard, folder_.path());
        PartFileWriter writer(file, header);
        for (const std::size_t index : cases_of(shard, names))
            if (index != left_out) writer.append(index, names[index] + " done");
        return file;
    }

    static std::string refusal(const std::vector<std::filesystem::path>& parts,
                               const std::vector<std::string>& of = names) {
        try {
            JoinedParts(parts).outcomes(of);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "joined";
    }

    testing::TemporaryFolder folder_;
};

TEST_F(JoinedPartsTest, GivesTheOutcomesInTheListsOrder) {
    write({1, 2}, {.command = {"force", "--quick"}});
    write({2, 2}, {.command = {"force", "--quick"}});
    const JoinedParts joined({folder_.path()});
    EXPECT_THAT(joined.command(), ::testing::ElementsAre("force", "--quick"));
    EXPECT_THAT(joined.outcomes(names),
                ::testing::ElementsAre("a done", "b done", "c done", "d done", "e done"));
}

TEST_F(JoinedPartsTest, RefusesAPartThatIsMissingThereTwiceOrNotDone) {
    const auto first = write({1, 3});
    const auto second = write({2, 3});
    EXPECT_EQ(refusal({first}), "missing of 3 parts: 2, 3");
    EXPECT_EQ(refusal({second, first}), "missing of 3 parts: 3");
    EXPECT_THAT(refusal({first, second, first}),
                AllOf(HasSubstr("part 1 is there twice: in "), HasSubstr("cases-1-of-3.jsonl and in ")));
    const std::size_t last = cases_of({3, 3}, names).back();
    const auto third = write({3, 3}, {}, last);
    EXPECT_THAT(refusal({first, second, third}),
                AllOf(HasSubstr("cases-3-of-3.jsonl: has done 0 of its 1 cases, not '" + names[last] + "'"),
                      HasSubstr("run part 3/3 again")));
}

TEST_F(JoinedPartsTest, RefusesPartsOfAnotherListOrBuild) {
    const auto first = write({1, 2}, {.command = {"force"}});
    EXPECT_THAT(refusal({first, write({2, 2}, {.command = {"force", "--quick"}})}),
                HasSubstr("cases-2-of-2.jsonl: of another list than"));
    EXPECT_THAT(refusal({write({1, 1}, {.command = {"force"}})}, {"a", "b"}),
                HasSubstr("is of another list of cases than 'force' has here"));
    EXPECT_THAT(refusal({write({1, 4}, {.program = "another"})}), HasSubstr("another build of this program"));
    EXPECT_THAT(refusal({folder_ / "nowhere"}), HasSubstr("nowhere: cannot be read"));
    const testing::TemporaryFolder empty;
    EXPECT_THAT(refusal({empty.path()}), HasSubstr("holds no cases-*.jsonl"));
}

}  // namespace
}  // namespace osteomill::study::joined_parts_test
