#include <gtest/gtest.h>

#include "common/text/foreign_text.h"

namespace osteomill {
namespace {

TEST(FileName, KeepsLettersOfAnyLanguage) {
    for (const char* name : {"Zähne von Jürgen", "下颌骨 3", "Челюсть", "l'os (2) #1", "عظم"})
        EXPECT_EQ(as_file_name(name), name);
}

TEST(FileName, HasNoSeparatorAndNoControlCharacter) {
    EXPECT_EQ(as_file_name("../a\\b"), ".._a_b");
    EXPECT_EQ(as_file_name("line\nbreak\x1b[31m"), "line_break_[31m");
    EXPECT_EQ(as_file_name("Z\xe4hne"), "Z_hne");
    EXPECT_EQ(as_file_name(".."), "__");
    EXPECT_EQ(as_file_name(""), "");
}

TEST(FileName, IsCutBetweenCharacters) {
    std::string text;
    for (int i = 0; i < 100; ++i) text += "ä";
    EXPECT_EQ(as_file_name(text), text.substr(0, 120));
}

}  // namespace
}  // namespace osteomill
