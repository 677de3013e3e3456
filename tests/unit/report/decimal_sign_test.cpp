#include <gtest/gtest.h>

#include "analysis/report/page_style.h"
#include "common/words/translation.h"

namespace osteomill {
namespace {

class DecimalSign : public ::testing::Test {
  protected:
    void TearDown() override { speak("en"); }
};

TEST_F(DecimalSign, IsACommaInGerman) {
    EXPECT_EQ(with_decimal_sign("-12.50"), "-12.50");
    speak("de");
    EXPECT_EQ(with_decimal_sign("-12.50"), "-12,50");
    EXPECT_EQ(with_decimal_sign("1.5e-07"), "1,5e-07");
    EXPECT_EQ(with_decimal_sign("unter 0.5 mm, 3 s"), "unter 0,5 mm, 3 s");
}

TEST_F(DecimalSign, LeavesWhatIsNoNumber) {
    speak("de");
    for (const char* const text : {"", "Version 0.3.1", "nach 3.", "...", ".5", "–", "28. November"})
        EXPECT_EQ(with_decimal_sign(text), text);
}

TEST(NumberWritten, HasAPointOrAComma) {
    EXPECT_EQ(number_written("0,5"), 0.5);
    EXPECT_EQ(number_written(" +0.5 "), 0.5);
    EXPECT_EQ(number_written("-115,5"), -115.5);
    EXPECT_EQ(number_written("1e-3"), 1e-3);
    for (const char* const text : {"", "0,5,1", "five", "1.5 mm", "-", "inf", "nan", "1e999"})
        EXPECT_FALSE(number_written(text)) << text;
}

TEST(ShownValue, HasNoShareThatNobodyReads) {
    EXPECT_EQ(shown_value("plan_removed_share", 1.8e-7).text(), "0 %");
    EXPECT_EQ(shown_value("plan_removed_share", 1.8e-4).text(), "0.018 %");
    EXPECT_EQ(shown_value("path_mm", 1.8e-5).number, "1.8e-05") << "no share";
}

}  // namespace
}  // namespace osteomill
