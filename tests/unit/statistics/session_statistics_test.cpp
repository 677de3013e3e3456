#include <gmock/gmock.h>

#include <array>

#include "analysis/statistics/cusum.h"
#include "analysis/statistics/group_comparison.h"
#include "analysis/statistics/practice_trend.h"

namespace osteomill {
namespace {

// Reference values are those of scipy 1.10.1 by the commands above them, with
//     a = [155.7, 162.3, 149.0, 171.2, 158.8]; b = [201.4, 188.9, 240.2, 195.0, 222.6, 210.7]
constexpr std::array a{155.7, 162.3, 149.0, 171.2, 158.8};
constexpr std::array b{201.4, 188.9, 240.2, 195.0, 222.6, 210.7};

TEST(MeanIntervalTest, IsStudents) {
    // stats.t.interval(0.95, len(a) - 1, loc=np.mean(a), scale=stats.sem(a))
    const auto mean = mean_interval(a);
    ASSERT_TRUE(mean && mean->interval);
    EXPECT_EQ(mean->n, 5u);
    EXPECT_NEAR(mean->mean, 159.4, 1e-9);
    EXPECT_NEAR(mean->interval->low, 149.2013344173156, 1e-8);
    EXPECT_NEAR(mean->interval->high, 169.59866558268442, 1e-8);
}

TEST(MeanIntervalTest, OfOneValueHasNoInterval) {
    EXPECT_FALSE(mean_interval({}));
    const std::array one{3.0};
    EXPECT_EQ(mean_interval(one)->mean, 3.0);
    EXPECT_FALSE(mean_interval(one)->interval);
}

TEST(GroupComparisonTest, OfMeansIsWelchs) {
    const auto welch = compare_means(a, b);
    ASSERT_TRUE(welch);
    // stats.ttest_ind(a, b, equal_var=False)
    EXPECT_NEAR(welch->t, -5.858867797055159, 1e-10);
    EXPECT_NEAR(welch->p, 0.0006116286979992797, 1e-12);
    // va, vb = np.var(a, ddof=1) / 5, np.var(b, ddof=1) / 6; df = (va + vb)**2 / (va**2 / 4 + vb**2 / 5)
    // d = np.mean(a) - np.mean(b); d -/+ stats.t.ppf(0.975, df) * np.sqrt(va + vb)
    EXPECT_NEAR(welch->degrees, 7.040952045084101, 1e-10);
    EXPECT_NEAR(welch->interval.low, -70.71735365002307, 1e-8);
    EXPECT_NEAR(welch->interval.high, -30.082646349976883, 1e-8);
    // np.exp(special.gammaln(9 / 2) - special.gammaln(8 / 2)) / np.sqrt(9 / 2) * d / pooled, with
    // pooled = np.sqrt((4 * np.var(a, ddof=1) + 5 * np.var(b, ddof=1)) / 9)
    EXPECT_NEAR(welch->hedges_g, -3.026057495166027, 1e-10);
}

TEST(GroupComparisonTest, OfMeansNeedsTwoValuesThatVary) {
    const std::array one{1.0};
    const std::array level{2.0, 2.0};
    EXPECT_FALSE(compare_means(one, a));
    EXPECT_FALSE(compare_means(level, level));
    EXPECT_TRUE(compare_means(level, a));
}

TEST(GroupComparisonTest, OfRanksIsMannsAndWhitneysExactly) {
    // stats.mannwhitneyu([3, 1, 8, 5], [2, 9, 10, 7, 12], method='exact')
    const std::array first{3.0, 1.0, 8.0, 5.0};
    const std::array second{2.0, 9.0, 10.0, 7.0, 12.0};
    const auto ranks = compare_ranks(first, second);
    ASSERT_TRUE(ranks);
    EXPECT_EQ(ranks->u, 4.0);
    EXPECT_NEAR(ranks->p, 0.19047619047619047, 1e-14);
    EXPECT_NEAR(ranks->cliffs_delta, (4.0 - 16.0) / 20.0, 1e-14) << "4 pairs above, 16 below";
}

TEST(GroupComparisonTest, OfRanksCountsTiesExactly) {
    // def ranks(x, y, axis=-1):
    //     return stats.rankdata(np.concatenate([x, y], axis), axis=axis)[..., :np.shape(x)[axis]].sum(axis)
    // stats.permutation_test(([0, 0, 1, 2, 0], [1, 3, 2, 4, 1, 5]), ranks, n_resamples=np.inf,
    //                        permutation_type='independent', vectorized=True)
    const std::array first{0.0, 0.0, 1.0, 2.0, 0.0};
    const std::array second{1.0, 3.0, 2.0, 4.0, 1.0, 5.0};
    const auto ranks = compare_ranks(first, second);
    ASSERT_TRUE(ranks);
    EXPECT_EQ(ranks->u, 18.5 - 15.0);
    EXPECT_NEAR(ranks->p, 0.03896103896103896, 1e-14);
    EXPECT_FALSE(compare_ranks({}, second));
    EXPECT_EQ(compare_ranks(second, second)->p, 1.0);
}

TEST(PracticeTrendTest, IsThatOfALinearModelWithALevelForEachTrainee) {
    const std::array values{
        PracticeValue{"A", 1, 300.0}, PracticeValue{"A", 2, 251.0}, PracticeValue{"A", 3, 230.0},
        PracticeValue{"A", 4, 222.0}, PracticeValue{"A", 5, 210.0}, PracticeValue{"B", 1, 280.0},
        PracticeValue{"B", 2, 260.0}, PracticeValue{"B", 3, 233.0}, PracticeValue{"C", 1, 350.0},
        PracticeValue{"C", 2, 290.0}, PracticeValue{"C", 3, 285.0}, PracticeValue{"C", 4, 268.0}};
    const auto trend = practice_trend(values);
    ASSERT_TRUE(trend);
    // As of R's lm(y ~ trainee + log(n)). X: a column of ones for each trainee, and np.log(n);
    // be, rss, _, _ = np.linalg.lstsq(X, y); C = rss / 8 * np.linalg.inv(X.T @ X); tt = stats.t.ppf(.975, 8)
    EXPECT_EQ(trend->degrees(), 8.0);
    EXPECT_NEAR(trend->slope(), -53.282952475141144, 1e-9);
    EXPECT_NEAR(trend->slope_interval().low, -63.71932060487708, 1e-8);
    EXPECT_NEAR(trend->slope_interval().high, -42.846584345405205, 1e-8);
    EXPECT_NEAR(trend->p(), 2.4788891577115852e-06, 1e-14);
    // g = [5/12, 3/12, 4/12, np.log(n)]; g @ be, -/+ tt * np.sqrt(g @ C @ g), for n = 1 and 4
    EXPECT_NEAR(trend->at(1), 308.2415017381182, 1e-8);
    EXPECT_NEAR(trend->interval_at(1).low, 298.1362108202817, 1e-8);
    EXPECT_NEAR(trend->interval_at(1).high, 318.3467926559547, 1e-8);
    EXPECT_NEAR(trend->interval_at(4).low, 226.2583547458815, 1e-8);
    EXPECT_NEAR(trend->interval_at(4).high, 242.4929356101403, 1e-8);
    // stats.linregress(np.log([1, 2, 3, 4, 5]), [300., 251, 230, 222, 210]): slope, pvalue
    const auto alone = practice_trend(std::span(values).first(5));
    ASSERT_TRUE(alone);
    EXPECT_NEAR(alone->slope(), -55.11979284579402, 1e-9);
    EXPECT_NEAR(alone->p(), 0.0012590810834434442, 1e-12);
}

TEST(PracticeTrendTest, NeedsAttemptsOfOneTrainee) {
    const std::array two{PracticeValue{"A", 1, 3.0}, PracticeValue{"A", 2, 2.0}};
    const std::array strangers{PracticeValue{"A", 1, 3.0}, PracticeValue{"B", 1, 2.0},
                               PracticeValue{"C", 1, 2.0}};
    EXPECT_FALSE(practice_trend(two)) << "a line through two points leaves no degree of freedom";
    EXPECT_FALSE(practice_trend(strangers));
    EXPECT_FALSE(practice_trend({}));
}

TEST(CusumTest, RisesByFailuresAndFallsByPasses) {
    // P = ln 2, Q = ln(4/3): s = Q / (P + Q) = ln(4/3) / ln(8/3), h = ln 9 / ln(8/3)
    const CusumDesign design;
    EXPECT_NEAR(design.step(), 0.28768207245178 / 0.98082925301173, 1e-12);
    EXPECT_NEAR(design.rise(), 2.19722457733622 / 0.98082925301173, 1e-12);
    EXPECT_NEAR(design.fall(), design.rise(), 1e-12) << "both chances of an error are 0.1";
    const double s = design.step();
    EXPECT_THAT(cusum({true, false, true}),
                ::testing::Pointwise(::testing::DoubleNear(1e-12), {0.0, -s, 1.0 - 2.0 * s, 1.0 - 3.0 * s}));
}

}  // namespace
}  // namespace osteomill
