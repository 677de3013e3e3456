#include "haptic_server/streaming/unidentified_connections.h"

#include <gmock/gmock.h>

namespace osteomill {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const UnidentifiedConnections::Time opening{};

TEST(UnidentifiedConnections, GiveWayOldestFirstWhenTheirPlacesAreShort) {
    UnidentifiedConnections unidentified(48);
    for (UnidentifiedConnections::Id id = 1; id <= 48; ++id) {
        EXPECT_FALSE(unidentified.in_the_way());
        unidentified.add(id, Origin{}, opening);
    }
    EXPECT_EQ(unidentified.in_the_way(), 1U);
    EXPECT_TRUE(unidentified.remove(2)) << "it has spoken";
    EXPECT_FALSE(unidentified.remove(2));
    EXPECT_FALSE(unidentified.in_the_way());
}

TEST(UnidentifiedConnections, AreServedOnceAfterTheyHaveBeenSilentForAWhile) {
    UnidentifiedConnections unidentified;
    unidentified.add(1, Origin{}, opening);
    unidentified.add(2, Origin{}, opening + UnidentifiedConnections::patience);
    EXPECT_THAT(unidentified.take_patient(opening), IsEmpty());
    EXPECT_THAT(unidentified.take_patient(opening + UnidentifiedConnections::patience), ElementsAre(1));
    EXPECT_THAT(unidentified.take_patient(opening + 2 * UnidentifiedConnections::patience), ElementsAre(2));
    EXPECT_EQ(unidentified.size(), 2U) << "they still give way to others";
}

TEST(UnidentifiedConnections, AreServedAFewAtATime) {
    UnidentifiedConnections unidentified;
    const auto much_later = opening + 9 * UnidentifiedConnections::patience;
    for (UnidentifiedConnections::Id id = 1; id <= UnidentifiedConnections::most_served + 2; ++id)
        unidentified.add(id, Origin{}, opening);
    EXPECT_EQ(unidentified.take_patient(much_later).size(), UnidentifiedConnections::most_served);
    EXPECT_THAT(unidentified.take_patient(much_later), IsEmpty());
    unidentified.remove(1);
    EXPECT_EQ(unidentified.take_patient(much_later).size(), 1U);
}

}  // namespace
}  // namespace osteomill
