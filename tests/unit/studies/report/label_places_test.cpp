#include "analysis/output/label_places.h"

#include <gmock/gmock.h>

namespace osteomill::study {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;

TEST(LabelPlaces, LeavesAloneWhatIsFarEnoughApart) {
    EXPECT_THAT(label_places({3.0, 1.0, 2.0}, 1.0), ElementsAre(3.0, 1.0, 2.0));
}

TEST(LabelPlaces, SpreadsACrowdAboutItsMiddle) {
    EXPECT_THAT(label_places({5.0, 5.0, 5.0}, 1.0), ElementsAre(4.0, 5.0, 6.0));
    // The pair at 0 pushes what it meets, all by the same mean.
    EXPECT_THAT(label_places({0.0, 0.0, 0.6, 9.0}, 1.0),
                ElementsAre(DoubleEq(-0.8), DoubleEq(0.2), DoubleEq(1.2), 9.0));
}

}  // namespace
}  // namespace osteomill::study
