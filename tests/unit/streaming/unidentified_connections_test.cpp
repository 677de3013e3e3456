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
        EXPECT_FALSE(unidentified.next_to_go());
        unidentified.add(id, Origin{}, opening);
    }
    EXPECT_EQ(unidentified.next_to_go(), 1U);
    EXPECT_TRUE(unidentified.remove(2)) << "it has spoken";
    EXPECT_FALSE(unidentified.remove(2));
    EXPECT_FALSE(unidentified.next_to_go());
}

TEST(UnidentifiedConnections, AreOverdueOnceTheyHaveBeenSilentForAWhile) {
    UnidentifiedConnections unidentified;
    unidentified.add(1, Origin{}, opening);
    unidentified.add(2, Origin{}, opening + UnidentifiedConnections::patience);
    EXPECT_THAT(unidentified.overdue(opening), IsEmpty());
    EXPECT_THAT(unidentified.overdue(opening + UnidentifiedConnections::patience), ElementsAre(1));
    unidentified.remove(1);
    EXPECT_FALSE(unidentified.contains(1));
    EXPECT_TRUE(unidentified.contains(2));
    EXPECT_THAT(unidentified.overdue(opening + UnidentifiedConnections::patience), IsEmpty());
}

}  // namespace
}  // namespace osteomill
