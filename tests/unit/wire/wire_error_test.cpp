#include "common/wire/wire_error.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

TEST(OneLine, LeavesPlainTextAlone) {
    EXPECT_EQ(one_line(""), "");
    EXPECT_EQ(one_line("Fr\u00e4ser 1.5 mm"), "Fr\u00e4ser 1.5 mm");
    EXPECT_EQ(one_line(std::string(200, 'x')), std::string(200, 'x'));
}

TEST(OneLine, ReplacesWhatWouldBreakALineOrSteerATerminal) {
    EXPECT_EQ(one_line("a\nb\r\x1b[2J\x7f"), "a?b??[2J?");
    EXPECT_EQ(one_line(std::string_view("a\0b", 3)), "a?b");
}

TEST(OneLine, CutsLongTextBetweenCharacters) {
    EXPECT_EQ(one_line(std::string(201, 'x')), std::string(200, 'x') + "...");
    EXPECT_EQ(one_line(std::string(199, 'x') + "\u00e4y"), std::string(199, 'x') + "...");
    EXPECT_LE(one_line(std::string(5000, '\x80')).size(), 203U);
}

}  // namespace
}  // namespace osteomill
