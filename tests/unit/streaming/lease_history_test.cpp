#include <gmock/gmock.h>

#include "haptic_server/streaming/leases.h"

namespace osteomill {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(LeaseHistory, IsWrittenOnceByTheNamesOfThoseWhoWereThere) {
    LeaseHistory history;
    const auto peer_of = [](ToolLease::ClientId id) { return "number " + std::to_string(id); };
    const auto gone = [](ToolLease::ClientId) -> std::string { throw std::out_of_range("gone"); };
    EXPECT_THAT(history.update(std::nullopt, gone), IsEmpty());
    EXPECT_THAT(history.update(1, peer_of), ElementsAre("client number 1 moves the tool"));
    EXPECT_THAT(history.update(1, gone), IsEmpty());
    EXPECT_THAT(history.update(2, peer_of),
                ElementsAre("client number 1 no longer moves the tool", "client number 2 moves the tool"));
    EXPECT_THAT(history.update(std::nullopt, gone), ElementsAre("client number 2 no longer moves the tool"));
}

}  // namespace
}  // namespace osteomill
