#include "analysis/report/condition_text.h"

#include <gtest/gtest.h>

#include <string>

#include "common/scene/rating_quantities.h"
#include "common/words/translation.h"

namespace osteomill {
namespace {

class ConditionText : public ::testing::Test {
  protected:
    void TearDown() override { speak("en"); }
};

TEST_F(ConditionText, SaysAConditionInWordsWithUnits) {
    EXPECT_EQ(condition_text("plan_removed_share >= 0.5 and plan_excess_mm3 <= 15"),
              "share of the plan removed ≥ 50 % and removed beyond the margin ≤ 15 mm³");
    EXPECT_EQ(condition_text("structure_touches('Facial_Nerve')+structure_touches(\"Incus\") == 0"),
              "touches (Facial Nerve) + touches (Incus) = 0");
    EXPECT_EQ(
        condition_text("not (structure_near_2_mm_cutting_s('pulp') != 0 or "
                       "structure_near_2_mm_force_ratio('pulp') > 1)"),
        "not (time of cutting within 2 mm (pulp) ≠ 0 s or force within 2 mm by that elsewhere (pulp) > 1)");
}

TEST_F(ConditionText, GivesNoUnitToANumberThatIsReckonedWith) {
    EXPECT_EQ(condition_text("time_s < 2 * idle_s"), "time < 2 · time idle");
    EXPECT_EQ(condition_text("removed_mm3 / time_s >= 0.5"), "bone removed / time ≥ 0.5");
    EXPECT_EQ(condition_text("2 < strokes"), "2 < strokes");
}

TEST_F(ConditionText, HasGermanWordsAndDecimalSigns) {
    speak("de");
    EXPECT_EQ(condition_text("plan_removed_share >= 0.5 and plan_surface_mean_mm <= 0.4"),
              "abgetragener Anteil des Plans ≥ 50 % und mittlerer Abstand der Flächen ≤ 0,4 mm");
}

TEST_F(ConditionText, LeavesAConditionThatCannotBeRead) {
    EXPECT_EQ(condition_text("(time_s <"), "(time_s <");
    EXPECT_EQ(condition_text("structure_touches('"), "structure_touches('");
}

TEST_F(ConditionText, HasWordsForEveryQuantity) {
    for (const RatedQuantity& one : rated_quantities) {
        const std::string text = quantity_text(one.key, "");
        EXPECT_FALSE(text.empty()) << one.key;
        EXPECT_EQ(text.find_first_of("_{"), std::string::npos) << one.key;
    }
}

TEST_F(ConditionText, ShowsValuesWithTheirUnits) {
    EXPECT_EQ(quantity_value("burr_in_view_share", 0.875).text(), "87.5 %");
    EXPECT_EQ(quantity_value("burr_in_view_share", 1.8e-7).text(), "0 %") << "nobody reads 1.8e-05 %";
    EXPECT_EQ(quantity_value("cutting_speed_mean_mm_per_s", 2.5).text(), "2.50 mm/s");
    EXPECT_EQ(quantity_value("force_impulse_n_s", 3.0).text(), "3 N s");
    EXPECT_EQ(quantity_value("stroke_reaches_per_s", 3.0).text(), "3 1/s");
    EXPECT_EQ(quantity_value("strokes", 3.0).text(), "3");
}

}  // namespace
}  // namespace osteomill
