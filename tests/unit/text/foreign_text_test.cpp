#include "common/text/foreign_text.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace osteomill {
namespace {

TEST(PlainText, IsUtf8WithoutControlCharacters) {
    EXPECT_EQ(why_not_plain(""), std::nullopt);
    EXPECT_EQ(why_not_plain("Z\u00e4hne, \u9aa8 \U0001f9b7 [a,b] -x \\ {}"), std::nullopt);
}

TEST(PlainText, SaysWhichByteIsNot) {
    EXPECT_EQ(why_not_plain("Z\xe4hne"), "is no UTF-8 (byte 2 is \\xe4)");
    EXPECT_EQ(why_not_plain("abc\xe2\x82"), "is no UTF-8 (byte 4 is \\xe2)") << "cut within a character";
    EXPECT_EQ(why_not_plain("a\x1b[2J"), "holds a control character (byte 2 is \\x1b)");
}

TEST(PlainText, KnowsControlsOfEachKind) {
    for (const char* control :
         {"\n", "\r", "\t", "\x01", "\x7f", "\xc2\x85", "\xc2\x9b", "\u2028", "\u202e", "\u2066"})
        EXPECT_TRUE(why_not_plain(std::string("a") + control + "b")) << printable(control);
    EXPECT_TRUE(why_not_plain(std::string_view("a\0b", 3)));
}

TEST(PlainText, TakesNoOverlongFormsSurrogatesOrCodesThatAreNone) {
    for (const char* wrong : {"\xc0\xaf", "\xe0\x80\xaf", "\xf0\x80\x80\xaf", "\xed\xa0\x80",
                              "\xf4\x90\x80\x80", "\xf8\x88\x80\x80\x80", "\x80", "\xff"})
        EXPECT_TRUE(why_not_plain(wrong)) << printable(wrong);
}

TEST(PlainText, IsRefusedByName) {
    EXPECT_NO_THROW(require_plain("a note", "calm"));
    try {
        require_plain("a note", "Z\xe4hne");
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "a note 'Z\\xe4hne' is no UTF-8 (byte 2 is \\xe4)");
    }
}

TEST(Printable, LeavesPlainTextAlone) {
    EXPECT_EQ(printable("Fr\u00e4ser 1.5 mm\\n"), "Fr\u00e4ser 1.5 mm\\n");
    EXPECT_EQ(printable(std::string(5000, 'x')), std::string(5000, 'x'));
}

TEST(Printable, ShowsWhatWouldBreakALineOrSteerATerminal) {
    EXPECT_EQ(printable("a\nb\r\x1b[2J\x7f"), "a\\x0ab\\x0d\\x1b[2J\\x7f");
    EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
    EXPECT_EQ(printable("\xc2\x9b"
                        "2J \xe4"),
              "\\xc2\\x9b2J \\xe4");
}

TEST(OneLine, CutsLongTextBetweenCharacters) {
    EXPECT_EQ(one_line(std::string(200, 'x')), std::string(200, 'x'));
    EXPECT_EQ(one_line(std::string(201, 'x')), std::string(200, 'x') + "...");
    EXPECT_EQ(one_line(std::string(199, 'x') + "\u00e4y"), std::string(199, 'x') + "...");
    EXPECT_EQ(one_line("a\nb"), "a\\x0ab");
}

}  // namespace
}  // namespace osteomill
