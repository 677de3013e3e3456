// What is made of a whole map: scores, bars, regions, tables.
#include <gmock/gmock.h>

#include <algorithm>

#include "studies/stability/map/implicit_bars.h"
#include "studies/stability/map/map_summary.h"
#include "studies/stability/map/map_table.h"
#include "studies/stability/map/method_score.h"
#include "studies/stability/map/region_table.h"
#include "tests/unit/studies/stability/map/whole_map.h"

namespace osteomill::study::map_results_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Stable up to half a millimetre and 400 N/m; the error is a tenth of the truth's newton, a fifth on the
/// bare arm.
MapOutcome outcome(const MapCase& c) {
    const bool is_cutting = c.scene == MapScene::cutting;
    return {
        .resistance_n_s_per_m = is_cutting ? 4e6 * c.depth_mm * c.relative_stiffness / c.spindle_rpm : 0.0,
        .truth_mean_n = 2.0,
        .is_stable = is_cutting ? c.depth_mm <= 0.5 : c.wall_n_per_mm <= 0.4,
        .rms_error_n = c.grip == MapGrip::bare_arm ? 0.4 : 0.2,
        .peak_n = 1.0 + c.depth_mm,
        .removed_mm3 = c.milling_rate_hz == 100.0 ? 1.01 : 1.0};
}

TEST(MapResults, ScoreCountsTheStableAndTakesTheirMedianError) {
    const WholeMap map = whole_map({.quick = true, .methods = {"hold", "interpolate"}}, outcome);
    const auto scores = method_scores(map, MapPart::map, MapScene::cutting);
    ASSERT_EQ(scores.size(), 2U);
    EXPECT_EQ(scores[0].method, "hold");
    EXPECT_DOUBLE_EQ(scores[0].share(), 1.0 / 3.0) << "two of six slots";
    EXPECT_DOUBLE_EQ(scores[0].median_rms_error, 0.1);
    EXPECT_DOUBLE_EQ(scores[0].worst_rms_error, 0.2);
    const auto summary = summary_of(map);
    EXPECT_EQ(summary["methods"]["hold"]["cutting"]["stable_share"], 1.0 / 3.0);
    EXPECT_EQ(summary["methods"]["hold"]["wall"]["stable_up_to_n_per_mm"]["firm"], 0.1);
    EXPECT_EQ(summary["methods"]["hold"]["cutting"]["stable_up_to_n_s_per_m"]["firm"], 20.0);
}

TEST(MapResults, AMethodThatIsStableNowhereHasNoErrorToDraw) {
    const WholeMap map = whole_map({.quick = true, .methods = {"hold"}}, [](const MapCase& c) {
        MapOutcome unstable = outcome(c);
        unstable.is_stable = false;
        return unstable;
    });
    EXPECT_THAT(pareto_table_of(method_scores(map, MapPart::map, MapScene::wall)).csv(),
                HasSubstr(",hold,-1,2,0,,\n"));
}

TEST(MapResults, BarsAreHeldAgainstTheWorst) {
    const WholeMap map = whole_map({.quick = true, .methods = {"implicit"}}, outcome);
    const auto bars = implicit_bars(map);
    ASSERT_EQ(bars.size(), 11U);
    const auto in_range = [](const MapPoint& p) {
        return p.run.scene == MapScene::cutting && p.run.is_ideal_device && p.run.delay_ticks <= 1;
    };
    const auto fails = [&](const MapPoint& p) { return in_range(p) && !outcome(p.run).is_stable; };
    const auto& points = map.points;
    EXPECT_DOUBLE_EQ(bars[0].worst,
                     100.0 * static_cast<double>(std::count_if(points.begin(), points.end(), fails)) /
                         static_cast<double>(std::count_if(points.begin(), points.end(), in_range)));
    EXPECT_THAT(bars[0].where, HasSubstr("mm deep"));
    EXPECT_FALSE(bars[0].is_met());
    EXPECT_FALSE(bars[6].is_met()) << "walls of more than 0.4 N/mm";
    EXPECT_DOUBLE_EQ(bars[1].worst, 20.0) << "rms error";
    EXPECT_DOUBLE_EQ(bars[3].worst, 6.0) << "force";
    EXPECT_NEAR(bars[5].worst, 1.0, 1e-9) << "bone carved at either rate";
    EXPECT_TRUE(bars[5].is_met());
    EXPECT_TRUE(bars[8].is_met() && bars[9].is_met() && bars[10].is_met());
}

TEST(MapResults, AFallbackAnywhereMissesTheBar) {
    const WholeMap map = whole_map({.quick = true, .methods = {"implicit"}}, [](const MapCase& c) {
        MapOutcome fell_back = outcome(c);
        if (c.scene == MapScene::wall && c.is_ideal_device) {
            fell_back.max_residual_n = 0.002;
            fell_back.fallbacks = 3.0;
            fell_back.energy_faults = 1.0;
        }
        return fell_back;
    });
    const auto bars = implicit_bars(map);
    for (std::size_t i = 8; i < bars.size(); ++i) EXPECT_FALSE(bars[i].is_met()) << bars[i].what;
    EXPECT_THAT(bars[9].where, HasSubstr("wall of"));
}

TEST(MapResults, RegionsJoinNeighboursThatAreAlike) {
    const WholeMap map = whole_map(
        {.methods = {"hold"}, .grips = {MapGrip::light}, .milling_rates_hz = {1000.0}, .delays_ticks = {0}},
        outcome);
    // Boxes meet at sqrt(0.32 * 0.47), the lowest begins at 0.1 / sqrt(1.5).
    EXPECT_EQ(region_table_of(map, MapScene::wall).csv(),
              "number,method,grip,x_low,x_high,y,stable\n"
              "3,hold,2,0.0816497,0.387814,1,1\n"
              "3,hold,2,0.387814,1.83712,1,0\n");
}

TEST(MapResults, TablesHaveALineACase) {
    const WholeMap map = whole_map({.quick = true, .methods = {"hold"}, .grips = {MapGrip::light}}, outcome);
    const std::string csv = map_table_of(map).csv();
    EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), map.points.size() + 1);
    EXPECT_THAT(csv, HasSubstr("\nmap,hold,cutting,light,1000,0,1,80000,0.1,1,1.5,1,5,2,"));
    EXPECT_THAT(error_table_of(map).csv(), HasSubstr("\n3,hold,light,5,10,1\n"));
    EXPECT_THAT(error_table_of(map).csv(), Not(HasSubstr("firm")));
}

}  // namespace
}  // namespace osteomill::study::map_results_test
