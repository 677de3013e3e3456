#include "studies/polishing/force_record.h"

#include <gmock/gmock.h>

#include <fstream>
#include <stdexcept>

#include "tests/support/temporary_folder.h"

namespace osteomill::study {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(ForceRecord, ReadsTheColumnsThatAStudyNeeds) {
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "force.csv")
        << "header\n0.0010,1,2,3,4,5,6,0.7,-0.8,0.9,10.5,11.25,1,0\n0.0020,0,0,0,0,0,0,0,0,0,0,0,0,0\n";
    const ForceRecord felt = read_force_log(folder / "force.csv");
    ASSERT_EQ(felt.size(), 2u);
    EXPECT_EQ(felt[0].time_s, 0.001);
    EXPECT_EQ(felt[0].burr_mm, glm::dvec3(4.0, 5.0, 6.0)) << "not the hand";
    EXPECT_EQ(felt[0].force_n, glm::dvec3(0.7, -0.8, 0.9));
    EXPECT_EQ(felt[0].removed_mm3, 11.25);
}

TEST(ForceRecord, SaysWhichLineIsWrong) {
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "short.csv") << "header\n1,2,3,4,5,6,7,8,9,10,11,12,13,14\n1,2,3,4,5,6,7,8\n";
    EXPECT_THAT([&] { read_force_log(folder / "short.csv"); },
                ThrowsMessage<std::runtime_error>(HasSubstr("short.csv, line 3: 14 numbers were expected")));
    EXPECT_THAT([&] { read_force_log(folder / "none.csv"); },
                ThrowsMessage<std::runtime_error>(HasSubstr("none.csv: cannot be read")));
}

}  // namespace
}  // namespace osteomill::study
