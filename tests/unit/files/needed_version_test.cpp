#include "common/files/needed_version.h"

#include <gmock/gmock.h>

namespace osteomill {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(NeededVersion, IsThisOneOrAnEarlier) {
    for (const char* version : {"0", "0.1", "0.2.9", "0.3", "0.3.0"})
        EXPECT_EQ(why_not_for_this_version(version), std::nullopt) << version;
}

TEST(NeededVersion, OfALaterOneIsNamed) {
    for (const std::string version : {"99", "1000.0.0", "99.10.2"})
        EXPECT_THAT(why_not_for_this_version(version).value_or("none"),
                    AllOf(HasSubstr("needs Osteomill " + version + " or later"), HasSubstr("this is 0.")));
}

TEST(NeededVersion, IsANumberOfUpToThreeParts) {
    for (const char* text : {"", "x", "0.", ".3", "0.3.0.1", "0.3 ", "-1", "0.3\n", "99999999999"})
        EXPECT_THAT(why_not_for_this_version(text).value_or("none"), HasSubstr("a version such as 0.3"))
            << text;
}

}  // namespace
}  // namespace osteomill
