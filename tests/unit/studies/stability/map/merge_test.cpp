#include "studies/stability/map/merge.h"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "studies/stability/map/case_file.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::study::merge_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class MergeTest : public ::testing::Test {
  protected:
    std::filesystem::path write(const Shard& shard, const MapSelection& selection) const {
        const auto points = map_points(selection);
        const auto file = case_file_of(shard, folder_.path());
        CaseFileWriter writer(file, selection, points, shard);
        for (const std::size_t index : cases_of(shard, points))
            writer.append(index, {.peak_n = static_cast<double>(index)});
        return file;
    }

    static std::string refusal(const std::vector<std::filesystem::path>& parts) {
        try {
            merge(parts);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "merged";
    }

    testing::TemporaryFolder folder_;
    MapSelection few_{.quick = true, .methods = {"hold"}};
};

TEST_F(MergeTest, PutsTheCasesInTheListsOrder) {
    write({1, 2}, few_);
    write({2, 2}, few_);
    const WholeMap map = merge({folder_.path()});
    ASSERT_EQ(map.points, map_points(few_));
    for (std::size_t i = 0; i < map.outcomes.size(); ++i)
        EXPECT_EQ(map.outcomes[i].peak_n, static_cast<double>(i));
}

TEST_F(MergeTest, RefusesAMissingADoubledAndAStrangePart) {
    const auto first = write({1, 2}, few_);
    const auto second = write({2, 2}, few_);
    EXPECT_THAT(refusal({first}), HasSubstr("cases are missing, the first is case"));
    EXPECT_THAT(refusal({first, second, first}),
                AllOf(HasSubstr("is there twice: in "), HasSubstr("hold, ")));
    const auto other = write({1, 3}, {.quick = true, .methods = {"interpolate"}});
    EXPECT_THAT(refusal({first, other}), HasSubstr("cases-1-of-3.jsonl: of another list than"));
    EXPECT_THAT(refusal({folder_ / "nowhere"}), HasSubstr("nowhere: cannot be read"));
    const testing::TemporaryFolder empty;
    EXPECT_THAT(refusal({empty.path()}), HasSubstr("holds no cases-*.jsonl"));
}

TEST_F(MergeTest, RefusesAPartOfAnotherVersionsList) {
    const auto part = write({1, 1}, few_);
    std::ostringstream text;
    text << std::ifstream(part).rdbuf();
    std::string changed = text.str();
    const std::string mine = fingerprint_of(map_points(few_));
    changed.replace(changed.find(mine), mine.size(), "0123456789abcdef");
    std::ofstream(part) << changed;
    EXPECT_THAT(refusal({part}), HasSubstr("of another version of the list of cases"));
}

}  // namespace
}  // namespace osteomill::study::merge_test
