#include "haptic_server/streaming/newcomers.h"

#include <gmock/gmock.h>

namespace osteomill {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const Newcomers::Time opening{};

TEST(Newcomers, GiveWayOldestFirstWhenTheirPlacesAreShort) {
    Newcomers newcomers(48);
    for (Newcomers::Id id = 1; id <= 48; ++id) {
        EXPECT_FALSE(newcomers.in_the_way());
        newcomers.add(id, Origin{}, opening);
    }
    EXPECT_EQ(newcomers.in_the_way(), 1U);
    EXPECT_TRUE(newcomers.remove(2)) << "it has spoken";
    EXPECT_FALSE(newcomers.remove(2));
    EXPECT_FALSE(newcomers.in_the_way());
}

TEST(Newcomers, AreServedOnceAfterTheyHaveBeenSilentForAWhile) {
    Newcomers newcomers;
    newcomers.add(1, Origin{}, opening);
    newcomers.add(2, Origin{}, opening + Newcomers::patience);
    EXPECT_THAT(newcomers.take_patient(opening), IsEmpty());
    EXPECT_THAT(newcomers.take_patient(opening + Newcomers::patience), ElementsAre(1));
    EXPECT_THAT(newcomers.take_patient(opening + 2 * Newcomers::patience), ElementsAre(2));
    EXPECT_EQ(newcomers.size(), 2U) << "they still give way to others";
}

TEST(Newcomers, AreServedAFewAtATime) {
    Newcomers newcomers;
    const auto much_later = opening + 9 * Newcomers::patience;
    for (Newcomers::Id id = 1; id <= Newcomers::most_served + 2; ++id) newcomers.add(id, Origin{}, opening);
    EXPECT_EQ(newcomers.take_patient(much_later).size(), Newcomers::most_served);
    EXPECT_THAT(newcomers.take_patient(much_later), IsEmpty());
    newcomers.remove(1);
    EXPECT_EQ(newcomers.take_patient(much_later).size(), 1U);
}

}  // namespace
}  // namespace osteomill
