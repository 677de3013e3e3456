#include "common/scene/rating_condition.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "common/scene/rating_quantities.h"
#include "tests/support/message_of.h"

namespace osteomill {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double without_bound = std::numeric_limits<double>::infinity();

/// time_s = 10, removed_mm3 = 4, two touches of the nerve; the nerve is further than 3 mm; nothing else is
/// known.
std::optional<bool> rating_holds(const std::string& text) {
    return RatingCondition(text).holds([](const AskedQuantity& asked) -> ValueRange {
        if (asked.key == "time_s") return ValueRange::of(10.0);
        if (asked.key == "removed_mm3") return ValueRange::of(4.0);
        if (asked.key == "structure_touches" && asked.of == "the nerve") return ValueRange::of(2.0);
        if (asked.key == "structure_nearest_mm") return {.low = 3.0};
        return {};
    });
}

std::string wrong_in(const std::string& text) {
    return testing::message_of<ConditionError>([&] { const RatingCondition condition(text); });
}

TEST(RatingCondition, HandsOutItsPiecesInOrder) {
    const RatingCondition condition("not (structure_touches ( 'the nerve' )+1 >= -2.5) or time_s<3*undos");
    std::string pieces;
    for (const ConditionPiece& one : condition.pieces()) {
        if (one.kind == ConditionPiece::Kind::number)
            pieces += std::to_string(static_cast<int>(10 * one.number));
        else if (one.kind == ConditionPiece::Kind::quantity)
            pieces += one.quantity.key + "," + one.quantity.of;
        else
            pieces += one.text;
        pieces += ' ';
    }
    EXPECT_EQ(pieces, "not ( structure_touches,the nerve + 10 >= - 25 ) or time_s, < 30 * undos, ");
}

TEST(RatingCondition, ComparesNumbers) {
    for (const char* yes : {"time_s < 10.5", "time_s <= 10", "time_s > 9", "time_s >= 1e1", "time_s == 10",
                            "time_s != 9", "-time_s < -9.5", "structure_touches(\"the nerve\") == 2",
                            "structure_touches('the nerve')==2", "\ttime_s\n<\n11 "})
        EXPECT_EQ(rating_holds(yes), true) << yes;
    for (const char* no :
         {"time_s < 10", "time_s <= 9.9", "time_s > 10", "time_s >= 10.1", "time_s == 9", "time_s != 10"})
        EXPECT_EQ(rating_holds(no), false) << no;
}

TEST(RatingCondition, BindsAsArithmeticAndLogicDo) {
    EXPECT_EQ(rating_holds("2 + 3 * 4 == 14"), true);
    EXPECT_EQ(rating_holds("(2 + 3) * 4 == 20"), true);
    EXPECT_EQ(rating_holds("12 / 2 / 3 == 2 and 9 - 4 - 3 == 2"), true);
    EXPECT_EQ(rating_holds("removed_mm3 / time_s == 0.4"), true);
    EXPECT_EQ(rating_holds("1 == 1 or 1 == 2 and 1 == 2"), true);
    EXPECT_EQ(rating_holds("(1 == 1 or 1 == 2) and 1 == 2"), false);
    EXPECT_EQ(rating_holds("not 1 == 2 and not not 1 == 1"), true);
    EXPECT_EQ(rating_holds("not (1 == 1 or 1 == 2)"), false);
}

TEST(RatingCondition, DecidesWhatDoesNotDependOnTheUnknown) {
    EXPECT_EQ(rating_holds("peak_force_n < 3"), std::nullopt);
    EXPECT_EQ(rating_holds("not peak_force_n < 3"), std::nullopt);
    EXPECT_EQ(rating_holds("peak_force_n < 3 and time_s > 10"), false);
    EXPECT_EQ(rating_holds("peak_force_n < 3 and time_s == 10"), std::nullopt);
    EXPECT_EQ(rating_holds("peak_force_n < 3 or time_s == 10"), true);
    EXPECT_EQ(rating_holds("structure_nearest_mm('the nerve') >= 2"), true) << "it is further than 3";
    EXPECT_EQ(rating_holds("structure_nearest_mm('the nerve') < 1"), false);
    EXPECT_EQ(rating_holds("structure_nearest_mm('the nerve') > 5"), std::nullopt);
    EXPECT_EQ(rating_holds("structure_nearest_mm('the nerve') == 2"), false);
    EXPECT_EQ(rating_holds("1 / structure_nearest_mm('the nerve') < 0.5"), true);
    EXPECT_EQ(rating_holds("2 * structure_nearest_mm('the nerve') - 1 >= 5"), true);
    EXPECT_EQ(rating_holds("-structure_nearest_mm('the nerve') <= -3"), true);
    EXPECT_EQ(rating_holds("structure_nearest_mm('the nerve') - structure_nearest_mm('the nerve') == 0"),
              std::nullopt)
        << "each is any number";
    EXPECT_EQ(rating_holds("time_s / (removed_mm3 - 4) > 1"), std::nullopt) << "divided by nothing";
    EXPECT_EQ(rating_holds("peak_force_n * 0 == 0"), true);
}

TEST(RatingCondition, TakesWhatIsNoNumberForUnknown) {
    const RatingCondition condition("time_s > 1");
    const auto with = [&](const ValueRange& value) {
        return condition.holds([&](const AskedQuantity&) { return value; });
    };
    EXPECT_EQ(with(ValueRange::of(std::nan(""))), std::nullopt);
    EXPECT_EQ(with(ValueRange::of(without_bound)), true);
    EXPECT_EQ(with({.low = 2.0, .high = 0.0}), std::nullopt);
}

TEST(RatingCondition, AsksForEachQuantityOnce) {
    const RatingCondition condition(
        "structure_touches('a') + structure_touches('b') + structure_touches('a') + structure_touches < 3");
    EXPECT_THAT(condition.quantities(),
                ElementsAre(AskedQuantity{"structure_touches", "a"}, AskedQuantity{"structure_touches", "b"},
                            AskedQuantity{"structure_touches", ""}));
}

TEST(RatingCondition, SaysInOneLineWhatIsWrong) {
    EXPECT_THAT(wrong_in("time > 1"),
                HasSubstr("'time', which is no quantity; did you mean 'time_s'? (letter 1)"));
    EXPECT_THAT(wrong_in("1 < structure_touch('a')"),
                HasSubstr("did you mean 'structure_touches'? (letter 5)"));
    EXPECT_THAT(wrong_in(""), HasSubstr("ends where a number or a quantity is missing"));
    EXPECT_THAT(wrong_in("time_s"), HasSubstr("a comparison belongs there"));
    EXPECT_THAT(wrong_in("time_s and 1 < 2"), HasSubstr("gives 'and' a number"));
    EXPECT_THAT(wrong_in("(1 < 2) + 1 > 2"), HasSubstr("gives + a comparison"));
    EXPECT_THAT(wrong_in("(1 < 2) < 3"), HasSubstr("gives < a comparison"));
    EXPECT_THAT(wrong_in("1 < time_s < 3"), HasSubstr("join two comparisons by 'and'"));
    EXPECT_THAT(wrong_in("time_s = 3"), HasSubstr("a comparison is written =="));
    EXPECT_THAT(wrong_in("time_s < 3 removed_mm3 > 1"), HasSubstr("put 'and' or 'or' between"));
    EXPECT_THAT(wrong_in("(time_s < 3"), HasSubstr("misses a ')'"));
    EXPECT_THAT(wrong_in("time_s < 3)"), HasSubstr("(letter 11)"));
    EXPECT_THAT(wrong_in("structure_touches(nerve) < 1"), HasSubstr("a name in quotes"));
    EXPECT_THAT(wrong_in("structure_touches('nerve) < 1"), HasSubstr("a name in quotes"));
    EXPECT_THAT(wrong_in("structure_touches('') < 1"), HasSubstr("a name in quotes"));
    EXPECT_THAT(wrong_in("time_s < 3x"), HasSubstr("no number that can be read"));
    EXPECT_THAT(wrong_in("time_s < 1e999"), HasSubstr("no number that can be read"));
    EXPECT_THAT(wrong_in("time_s < 1.2.3"), HasSubstr("no number that can be read"));
    EXPECT_THAT(wrong_in("time_s < nan"), HasSubstr("'nan', which is no quantity"));
    EXPECT_THAT(wrong_in("time_s < inf"), HasSubstr("'inf', which is no quantity"));
    EXPECT_THAT(wrong_in("system('rm') < 1"), HasSubstr("'system', which is no quantity"));
    EXPECT_THAT(wrong_in("time_s < ; 1"), HasSubstr("has ';'"));
    EXPECT_THAT(wrong_in("time_s < \x1b[2J"), HasSubstr("has '\\x1b'"));
    EXPECT_THAT(wrong_in("and"), HasSubstr("misses a comparison"));
}

TEST(RatingCondition, IsBoundInDepthAndLength) {
    const auto in_parentheses = [](int n) { return std::string(n, '(') + "1 < 2" + std::string(n, ')'); };
    EXPECT_EQ(wrong_in(in_parentheses(RatingCondition::deepest - 1)), "");
    EXPECT_THAT(wrong_in(in_parentheses(RatingCondition::deepest)), HasSubstr("deep within itself"));
    EXPECT_THAT(wrong_in(std::string(499, '(')), HasSubstr("deep within itself"));
    EXPECT_THAT(wrong_in(std::string(400, '-') + "1 < 2"), HasSubstr("deep within itself"));
    std::string nots;
    for (int i = 0; i < 100; ++i) nots += "not ";
    EXPECT_THAT(wrong_in(nots + "1 < 2"), HasSubstr("deep within itself"));
    EXPECT_THAT(wrong_in("1 < 2" + std::string(500, ' ')), HasSubstr("505 letters; at most 500"));
    std::string sum = "1";
    while (sum.size() < 480) sum += "+1";
    EXPECT_EQ(rating_holds(sum + " > 100"), true);
}

TEST(RatedQuantities, HaveOneEntryEach) {
    for (const RatedQuantity& one : rated_quantities) EXPECT_EQ(rated_quantity(one.key), &one) << one.key;
    EXPECT_EQ(rated_quantity("passed"), nullptr) << "a rating does not judge itself";
    EXPECT_EQ(rated_quantity("rating_points"), nullptr);
}

}  // namespace
}  // namespace osteomill
