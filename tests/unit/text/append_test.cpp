#include "common/text/append.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

TEST(AppendFormatted, GoesBehindTheText) {
    std::string text = "t";
    append_formatted(text, "={:.2f} {}", 1.5, std::string("s"));
    EXPECT_EQ(text, "t=1.50 s");
    fmt::memory_buffer buffer;
    append_formatted(buffer, "{},", 1);
    append_formatted(buffer, "{}", "b");
    EXPECT_EQ(fmt::to_string(buffer), "1,b");
}

TEST(AppendFormatted, KeepsTheMemoryOfTheText) {
    std::string text(200, ' ');
    const char* const before = text.data();
    text.clear();
    append_formatted(text, "{:>100}", "b");
    EXPECT_EQ(text.data(), before);
}

}  // namespace
}  // namespace osteomill
