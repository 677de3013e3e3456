#include <gtest/gtest.h>

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

}  // namespace
}  // namespace osteomill
