#include "haptic_server/streaming/newcomers.h"

#include <gmock/gmock.h>

namespace osteomill {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const Newcomers::Time opening{};

TEST(Newcomers, GiveWayOldestFirstWhenTheirPlacesAreShort) {
    Newcomers newcomers;
    for (Newcomers::Id id = 1; id <= Newcomers::most_at_once; ++id) {
        EXPECT_FALSE(newcomers.in_the_way());
        newcomers.add(id, opening);
    }
    EXPECT_EQ(newcomers.in_the_way(), 1U);
    EXPECT_TRUE(newcomers.remove(2)) << "it has spoken";
    EXPECT_FALSE(newcomers.remove(2));
    EXPECT_FALSE(newcomers.in_the_way());
}

TEST(Newcomers, AreServedOnceAfterTheyHaveBeenSilentForAWhile) {
    Newcomers newcomers;
    newcomers.add(1, opening);
    newcomers.add(2, opening + Newcomers::patience);
    EXPECT_THAT(newcomers.take_patient(opening), IsEmpty());
    EXPECT_THAT(newcomers.take_patient(opening + Newcomers::patience), ElementsAre(1));
    EXPECT_THAT(newcomers.take_patient(opening + 2 * Newcomers::patience), ElementsAre(2));
    EXPECT_EQ(newcomers.size(), 2U) << "they still give way to others";
}

}  // namespace
}  // namespace osteomill
