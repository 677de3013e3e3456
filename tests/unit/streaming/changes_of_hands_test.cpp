#include "haptic_server/streaming/changes_of_hands.h"

#include <gmock/gmock.h>

namespace osteomill {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(ChangesOfHands, AreToldOnceByTheNamesOfThoseWhoWereThere) {
    ChangesOfHands changes;
    const auto peer_of = [](ControlLease::ClientId id) { return "number " + std::to_string(id); };
    const auto gone = [](ControlLease::ClientId) -> std::string { throw std::out_of_range("gone"); };
    EXPECT_THAT(changes.look(std::nullopt, gone), IsEmpty());
    EXPECT_THAT(changes.look(1, peer_of), ElementsAre("client number 1 moves the tool"));
    EXPECT_THAT(changes.look(1, gone), IsEmpty());
    EXPECT_THAT(changes.look(2, peer_of),
                ElementsAre("client number 1 no longer moves the tool", "client number 2 moves the tool"));
    EXPECT_THAT(changes.look(std::nullopt, gone), ElementsAre("client number 2 no longer moves the tool"));
}

}  // namespace
}  // namespace osteomill
