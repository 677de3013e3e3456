#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "haptic_server/streaming/live_session.h"

namespace osteomill {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class StructureLogTest : public ::testing::Test {
  protected:
    std::vector<std::string> at(std::optional<double> distance_mm) {
        if (distance_mm && *distance_mm <= 0.0 && !now_.touches) ++now_.touches_so_far;
        now_.touches = distance_mm && *distance_mm <= 0.0;
        now_.distance_mm = distance_mm;
        return log_.lines(std::span(&now_, 1), 2.0);
    }

    StructureLog log_{{{.label = 1, .name = "bone"},
                       {.label = 2, .name = "facial nerve", .is_protected = true, .warn_mm = 1.0}}};
    StructureDistance now_{.tissue = 1};
};

TEST_F(StructureLogTest, NamesEveryApproachAndEveryTouchOnce) {
    EXPECT_THAT(at(1.2), IsEmpty());
    EXPECT_THAT(at(0.96), ElementsAre("the burr is 0.96 mm from facial nerve (2.00 s)"));
    EXPECT_THAT(at(0.5), IsEmpty());
    EXPECT_THAT(at(1.1), IsEmpty()) << "not yet left";
    EXPECT_THAT(at(0.9), IsEmpty());
    EXPECT_THAT(at(-0.1), ElementsAre("the burr touches facial nerve (2.00 s; touch 1)"));
    EXPECT_THAT(at(-0.2), IsEmpty());
    EXPECT_THAT(at(0.2), IsEmpty());
    EXPECT_THAT(at({}), IsEmpty());
    EXPECT_THAT(at(-0.1), ElementsAre("the burr touches facial nerve (2.00 s; touch 2)"));
    EXPECT_THAT(log_.lines({}, 3.0), IsEmpty());
    EXPECT_THAT(at(0.4), ElementsAre("the burr is 0.40 mm from facial nerve (2.00 s)"));
}

TEST_F(StructureLogTest, IsBounded) {
    std::size_t lines = 0;
    std::string last;
    for (int i = 0; i < 1000; ++i)
        for (const std::optional<double> distance_mm : {std::optional<double>(), std::optional(0.5)})
            for (const std::string& line : at(distance_mm)) {
                ++lines;
                last = line;
            }
    EXPECT_EQ(lines, StructureLog::most_lines);
    EXPECT_EQ(
        last,
        "the burr is 0.50 mm from facial nerve (2.00 s); what follows of structures is left out of the log");
}

}  // namespace
}  // namespace osteomill
