#include "imaging/dicom/apart.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>
#include <stdexcept>

namespace osteomill::apart_test {
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

}  // namespace
}  // namespace osteomill::apart_test
