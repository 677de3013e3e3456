#include "imaging/dicom/own_process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

namespace osteomill::own_process_test {
namespace {

TEST(Apart, LeavesWhatItWroteAndSaysWhetherItSucceeded) {
    const SharedBytes shared(3);
    EXPECT_TRUE(succeeds_apart([&] { return shared.bytes()[1] = 'x', true; }));
    EXPECT_EQ(shared.bytes()[0], 0);
    EXPECT_EQ(shared.bytes()[1], 'x');
    EXPECT_FALSE(succeeds_apart([] { return false; }));
    EXPECT_FALSE(succeeds_apart([]() -> bool { throw std::runtime_error("no"); }));
}

TEST(Apart, EndsAloneWhereALibraryEndsItsProcess) {
    EXPECT_FALSE(succeeds_apart([]() -> bool { std::_Exit(3); }));
    EXPECT_FALSE(succeeds_apart([] { return ::raise(SIGKILL) == 0; }));
    EXPECT_FALSE(succeeds_apart([]() -> bool { std::abort(); }));
}

TEST(Apart, EndsAChildThatStandsStillAndTriesOnceMore) {
    const SharedBytes tries(1);
    const auto waits_for_ever = [&](int times) {
        return [&tries, times] {
            if (++tries.bytes()[0] <= times) ::pause();
            return true;
        };
    };
    EXPECT_TRUE(succeeds_apart(waits_for_ever(1), std::chrono::seconds(2)));
    EXPECT_EQ(tries.bytes()[0], 2);
    tries.bytes()[0] = 0;
    EXPECT_FALSE(succeeds_apart(waits_for_ever(2), std::chrono::seconds(2)));
    EXPECT_EQ(tries.bytes()[0], 2);
}

}  // namespace
}  // namespace osteomill::own_process_test
