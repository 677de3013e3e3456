#include "analysis/output/cases/part_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "tests/support/temporary_folder.h"

namespace osteomill::study::part_file_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const PartHeader header{
    .command = {"stability", "--quick"}, .program = "0123", .cases = "4567", .shard = {2, 3}};

class PartFileTest : public ::testing::Test {
  protected:
    std::string refusal(const PartHeader& other) const {
        try {
            PartFileWriter writer(file_, other);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "taken";
    }

    testing::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "cases.jsonl";
};

TEST_F(PartFileTest, GivesBackEveryBit) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const json third{{"peak_n", 1.0 / 3.0}, {"smallest", 5e-324}, {"text", "ünd"}};
    {
        PartFileWriter writer(file_, header);
        writer.append(4, third);
        writer.append(1, json::array({std::nextafter(1e17, 2e17), infinity, -infinity, nullptr, true}));
        writer.append(0, std::nan(""));
    }
    const PartFile read = read_part_file(file_);
    EXPECT_EQ(read.header, header);
    ASSERT_EQ(read.outcomes.size(), 3U);
    EXPECT_EQ(read.outcomes.at(4), third);
    EXPECT_EQ(read.outcomes.at(1),
              json::array({std::nextafter(1e17, 2e17), infinity, -infinity, nullptr, true}));
    EXPECT_TRUE(std::isnan(read.outcomes.at(0).get<double>()));
}

TEST_F(PartFileTest, IsTakenUpWithoutTheLineThatWasTorn) {
    {
        PartFileWriter writer(file_, header);
        writer.append(0, "first");
        writer.append(1, "second");
    }
    std::filesystem::resize_file(file_, std::filesystem::file_size(file_) - 5);
    {
        PartFileWriter writer(file_, header);
        EXPECT_EQ(writer.done_before(), (Outcomes{{0, "first"}}));
        writer.append(1, "again");
    }
    EXPECT_EQ(read_part_file(file_).outcomes.at(1), "again");
    // A kill at the very start leaves not even the first line.
    std::filesystem::resize_file(file_, 10);
    EXPECT_TRUE(PartFileWriter(file_, header).done_before().empty());
    EXPECT_EQ(read_part_file(file_).header, header);
}

TEST_F(PartFileTest, RefusesWhatIsOfAnotherListOrNone) {
    const PartFileWriter writer(file_, header);
    EXPECT_THAT(refusal(header), HasSubstr("another process is writing it"));
    std::filesystem::copy_file(file_, folder_ / "copy.jsonl");
    file_ = folder_ / "copy.jsonl";
    EXPECT_EQ(refusal(header), "taken");
    PartHeader other = header;
    other.command = {"stability"};
    EXPECT_THAT(refusal(other),
                HasSubstr("copy.jsonl: holds cases of another list (stability --quick, part 2/3)"));
    other = header;
    other.shard = {1, 2};
    EXPECT_THAT(refusal(other), HasSubstr("of another list"));
    other = header;
    other.program = "89ab";
    EXPECT_THAT(refusal(other), HasSubstr("of another build of this program"));
    std::ofstream(file_, std::ios::app) << "{\"case\":1}\n";
    EXPECT_THAT(refusal(header), HasSubstr("copy.jsonl: line 2 is no case"));
    std::ofstream(file_) << "name,age\n";
    EXPECT_THAT(refusal(header), HasSubstr("its first line is not that of a file of a study's cases"));
}

}  // namespace
}  // namespace osteomill::study::part_file_test
