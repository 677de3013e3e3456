#include "common/text/pattern.h"

#include <gmock/gmock.h>

#include <stdexcept>

namespace osteomill {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Pattern, TakesAllOfATextOrNot) {
    const Pattern subject("[A-Z]+=\\w+");
    EXPECT_TRUE(subject.takes("CN=viewer"));
    EXPECT_FALSE(subject.takes("CN=viewer,"));
}

TEST(Pattern, FindsItsFirstPartAndThoseOfItsGroups) {
    const Pattern parts("(\\d+) parts?( left out)?");
    EXPECT_THAT(parts.first_in("3 parts left out, 4 parts"),
                ElementsAre("3 parts left out", "3", " left out"));
    EXPECT_THAT(parts.first_in("1 part"), ElementsAre("1 part", "1", ""));
    EXPECT_THAT(parts.first_in("none"), IsEmpty());
}

TEST(Pattern, RefusesWhatIsNoExpression) {
    EXPECT_THROW(Pattern("("), std::runtime_error);
}

}  // namespace
}  // namespace osteomill
