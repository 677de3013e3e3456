#include "common/session/bounded_line.h"

#include <gtest/gtest.h>

#include <string>

namespace osteomill {
namespace {

TEST(BoundedLine, HoldsWhatItWasMadeOf) {
    EXPECT_TRUE(BoundedLine().empty());
    const BoundedLine line = "the device is lost";
    EXPECT_EQ(line.text(), "the device is lost");
    EXPECT_EQ(line, std::string("the device is lost"));
    EXPECT_FALSE(line == "the device is back");
    EXPECT_FALSE(line == BoundedLine());
}

TEST(BoundedLine, CutsWhatIsTooLong) {
    const std::string longest(BoundedLine::most_bytes, 'x');
    EXPECT_EQ(BoundedLine(longest).text(), longest);
    EXPECT_EQ(BoundedLine(longest + "y").text(), longest);
    EXPECT_EQ(BoundedLine(longest.substr(1) + "\u00e4").text(), longest.substr(1)) << "between characters";
}

TEST(BoundedLine, IsPlainTextWhateverADeviceSays) {
    EXPECT_EQ(BoundedLine("Z\u00e4hne").text(), "Z\u00e4hne");
    EXPECT_EQ(BoundedLine("a\x1b[2J\nb \xe4").text(), "a?[2J?b ?");
}

}  // namespace
}  // namespace osteomill
