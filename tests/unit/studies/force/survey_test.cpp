#include "tests/studies/force/survey.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

namespace osteomill::study {
namespace {

TEST(SurveyPoints, CoverWhatIsPromised) {
    const auto points = survey_points(false);
    std::set<double> diameters_mm;
    std::set<int> edges;
    const auto [least_depth, most_depth] = std::minmax_element(
        points.begin(), points.end(),
        [](const SurveyPoint& a, const SurveyPoint& b) { return a.motion.depth_mm < b.motion.depth_mm; });
    EXPECT_NEAR(least_depth->motion.depth_mm, 0.1, 0.01);
    EXPECT_EQ(most_depth->motion.depth_mm, 2.5);
    for (const SurveyPoint& p : points) {
        diameters_mm.insert(p.motion.burr.diameter_mm);
        edges.insert(p.motion.burr.edges);
        EXPECT_NEAR(glm::length(p.motion.spindle_axis), 1.0, 1e-9) << p.motion.name;
        EXPECT_NEAR(glm::length(p.motion.up), 1.0, 1e-9) << p.motion.name;
        EXPECT_NEAR(glm::dot(p.motion.spindle_axis, p.motion.up),
                    std::cos(p.tilt_deg * 3.14159265358979 / 180.0), 1e-9)
            << p.motion.name;
        const double speed = glm::length(p.motion.velocity_mm_per_s);
        EXPECT_GE(speed, 0.49) << p.motion.name;
        EXPECT_LE(speed, 50.01) << p.motion.name;
    }
    EXPECT_THAT(diameters_mm, ::testing::ElementsAre(1.0, 1.5, 2.0, 3.0, 4.0, 5.0));
    EXPECT_THAT(edges, ::testing::ElementsAre(2, 3, 6, 8, 12));
}

TEST(SurveyPoints, DemandOnePercentOfTheEasyMotionsAndTwoOfTheOthers) {
    for (const SurveyPoint& p : survey_points(false)) {
        const SteadyCase& c = p.motion;
        const bool easy = c.burr.diameter_mm == 5.0 && c.up == glm::dvec3(0, 0, 1) &&
                          c.spindle_axis == c.up && c.depth_mm > 0.3 && !c.previous_groove_mm_higher &&
                          std::abs(c.velocity_mm_per_s.z) < 1e-9;
        EXPECT_EQ(p.most_error, easy ? 0.01 : 0.02) << c.name;
        EXPECT_EQ(p.most_ripple.has_value(), c.burr.diameter_mm == 5.0) << c.name;
    }
}

TEST(SurveyPoints, AreFewerWhenQuickButOfEveryGroup) {
    const auto groups = [](const std::vector<SurveyPoint>& points) {
        std::map<std::string, int> counts;
        for (const SurveyPoint& p : points) ++counts[p.group];
        return counts;
    };
    const auto all = groups(survey_points(false));
    const auto quick = groups(survey_points(true));
    ASSERT_EQ(all.size(), quick.size());
    for (const auto& [group, count] : quick) EXPECT_LT(count, all.at(group)) << group;
}

SurveyResult result(const std::string& name, double error, double ripple, std::optional<double> most_ripple) {
    return {.point = {.group = "a", .motion = {.name = name}, .most_error = 0.02, .most_ripple = most_ripple},
            .error = error,
            .ripple = ripple};
}

TEST(SurveySummary, CountsMissesAndNamesTheWorstFirst) {
    const auto summary =
        summary_of({result("fine", 0.01, 0.01, 0.02), result("ripples", 0.01, 0.05, 0.02),
                    result("free to ripple", 0.01, 0.5, std::nullopt), result("errs", 0.03, 0.0, 0.02)});
    EXPECT_EQ(summary.at("all").at("points"), 4);
    EXPECT_EQ(summary.at("groups").at("a").at("miss_error"), 1);
    EXPECT_EQ(summary.at("groups").at("a").at("miss_ripple"), 1);
    EXPECT_DOUBLE_EQ(summary.at("all").at("error_percent").at("max"), 3.0);
    ASSERT_EQ(summary.at("worst").size(), 2u);
    EXPECT_EQ(summary.at("worst").at(0).at("name"), "ripples");
    EXPECT_EQ(summary.at("worst").at(1).at("name"), "errs");
}

TEST(SurveyMeasurement, IsTheSameEveryTime) {
    const SurveyPoint point = survey_points(true).front();
    const SurveyResult once = measure(point, voxel_model());
    const SurveyResult again = measure(point, voxel_model());
    EXPECT_EQ(once.force_n, again.force_n);
    EXPECT_EQ(once.reference_n, again.reference_n);
    EXPECT_EQ(once.ripple, again.ripple);
    EXPECT_GT(once.error, 0.0);
    EXPECT_LT(once.error, 0.05);
}

}  // namespace
}  // namespace osteomill::study
