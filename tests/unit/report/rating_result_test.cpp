#include "analysis/report/rating_result.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/report/metrics_csv_json.h"
#include "analysis/report/report_html.h"
#include "analysis/report/session_metrics.h"
#include "common/scene/rating_quantities.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/written_session.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A cube of 8 mm, 0.5 mm a voxel: a lesion (2) above z = 2, a nerve (3) below z = -3. The hand takes all
/// above z = 3 in 4 s, far from the nerve: 64 of the lesion's 128 mm^3.
class RatedSession : public ::testing::Test {
  protected:
    struct Report {
        RatingResult rating;
        std::vector<MetricRow> rows;
        nlohmann::json json;
        std::string html;
    };
    Report report(const Rating& rating, int undos = 0, bool is_whole = true) {
        const auto file = folder_ / "a.pcap";
        const Bone bone = testing::labelled_cube(1, 0.5, [](const glm::dvec3& at) {
            return static_cast<std::uint8_t>(at.z > 2.0 ? 2 : at.z < -3.0 ? 3 : 1);
        });
        testing::WrittenSession written(file,
                                        {.scene_name = "cube",
                                         .burrs = {Burr{.name = "round"}, Burr{.name = "small"}},
                                         .tissues = {{.label = 1, .name = "bone"},
                                                     {.label = 2, .name = "lesion"},
                                                     {.label = 3, .name = "nerve", .is_protected = true}},
                                         .plan = Plan{.region = TissueRegion{"lesion"}},
                                         .rating = rating},
                                        bone);
        const auto take = [](const glm::dvec3& at) { return at.z > 3.0; };
        ToolState tool{.burr_position_mm = {0.0, 0.0, 4.0}};
        written.frame(tool);
        tool.spindle_on = true;
        tool.time_s = 4.0;
        written.cut(take);
        written.frame(tool);
        for (int i = 0; i < undos; ++i) {
            tool.time_s += 0.5;
            written.event({.time_s = tool.time_s, .action = SessionAction::undo});
            written.restore(take);
            written.frame(tool);
            tool.time_s += 0.5;
            written.cut(take);
            written.frame(tool);
        }
        written.finish();
        if (!is_whole) std::filesystem::resize_file(file, std::filesystem::file_size(file) - 200);
        const SessionTrace trace = read_trace(file, [](double) {});
        const SessionMetrics metrics = session_metrics(trace);
        Report made{.rating = metrics.rating, .rows = metric_rows(metrics), .json = {}, .html = {}};
        made.json = nlohmann::json::parse(metrics_json(trace, made.rows, made.rating));
        made.html = report_html(trace, metrics, made.rows, {}, {});
        return made;
    }
    std::optional<bool> reached(const std::string& when, const std::optional<PlanRegion>& region = {}) {
        return report({{.name = "a", .when = when, .region = region}}).rating.items.at(0).is_reached;
    }

    testing::TemporaryFolder folder_;
};

TEST_F(RatedSession, DecidesOverWhatWasMeasured) {
    EXPECT_EQ(reached("removed_mm3 == 64 and plan_removed_share == 0.5 and plan_mm3 == 128"), true);
    EXPECT_EQ(reached("removed_of_tissue_mm3('lesion') == 64 and removed_of_tissue_mm3('bone') == 0"), true);
    EXPECT_EQ(reached("removed_by_burr_mm3('round') == 64 and removed_by_burr_mm3('small') == 0"), true)
        << "a burr that cut nothing took nothing";
    EXPECT_EQ(reached("removed_by_burr_mm3 == 64"), true) << "of all together";
    EXPECT_EQ(reached("structure_touches('nerve') == 0 and structure_touches == 0"), true);
    EXPECT_EQ(reached("structure_nearest_mm('nerve') > 2"), true) << "it is further than is looked at";
    EXPECT_EQ(reached("structure_nearest_mm('nerve') < 1"), false);
    EXPECT_EQ(reached("structure_nearest_mm('nerve') > 4"), std::nullopt);
    EXPECT_EQ(reached("structure_near_1_mm_cutting_s('nerve') == 0"), true);
    EXPECT_EQ(reached("structure_near_1_mm_force_ratio('nerve') < 1"), std::nullopt);
    EXPECT_EQ(reached("structure_near_1_mm_cutting_s('nerve') == 0 or "
                      "structure_near_1_mm_force_ratio('nerve') < 1"),
              true);
    EXPECT_EQ(reached("burr_in_view_share >= 0.9"), std::nullopt) << "nobody looked";
    EXPECT_EQ(reached("structure_under_2_mm_share('nerve') == 0"), true);
}

TEST_F(RatedSession, MeasuresTheItemsRegion) {
    // A sphere of 2 mm about the middle of the top: half of it is bone. Bone above z = 3 is removed: a zone
    // of the half ball, pi (r^2 h - h^3 / 3) with h = 1.
    const double r = 2.0;
    const double half_mm3 = 2.0 / 3.0 * 3.14159265 * r * r * r;
    const double zone_mm3 = 3.14159265 * (r * r * 1.0 - 1.0 / 3.0);
    const auto found =
        report({{.name = "a",
                 .when = "region_mm3 > 0 and region_removed_mm3 > 0 and region_removed_share > 0.6",
                 .region = SphereRegion{{0, 0, 4}, r}}})
            .rating.items.at(0);
    EXPECT_EQ(found.is_reached, true);
    EXPECT_NEAR(*found.values[0].value, half_mm3, 0.08 * half_mm3);
    EXPECT_NEAR(*found.values[1].value, zone_mm3, 0.08 * zone_mm3);
    EXPECT_NEAR(*found.values[2].value, zone_mm3 / half_mm3, 0.05);
    EXPECT_EQ(reached("region_removed_share == 0.5", TissueRegion{"lesion"}), true);
    EXPECT_EQ(reached("region_removed_share > 0", SphereRegion{{90, 0, 0}, 1.0}), std::nullopt)
        << "where no bone is there is no share";
}

TEST_F(RatedSession, AddsUpPointsAndSaysThemEverywhere) {
    const Report made =
        report({{.name = "Opened", .points = 2.0, .when = "removed_mm3 > 1", .source = "a book"},
                {.name = "All gone", .points = 3.0, .when = "plan_removed_share >= 0.9"},
                {.name = "Seen", .when = "burr_in_view_share > 0.9"},
                {.name = "Of a later version", .when = "what_nobody_knows > 1"}});
    EXPECT_EQ(made.rating.points(), 2.0);
    EXPECT_EQ(made.rating.most_points(), 7.0);
    const auto& metrics = made.json.at("metrics");
    EXPECT_EQ(metrics.at("rating_points"), 2.0);
    EXPECT_EQ(metrics.at("rating_share"), 2.0 / 7.0);
    EXPECT_EQ(metrics.at("rating_undecided"), 2.0);
    EXPECT_EQ(metrics.at("rating_item_points_of").at("All gone"), 0.0);
    const auto& items = made.json.at("rating").at("items");
    EXPECT_EQ(items.at(0).at("is_reached"), true);
    EXPECT_EQ(items.at(0).at("values").at("removed_mm3"), 64.0);
    EXPECT_EQ(items.at(0).at("source"), "a book");
    EXPECT_EQ(items.at(1).at("is_reached"), false);
    EXPECT_TRUE(items.at(2).at("is_reached").is_null());
    EXPECT_TRUE(items.at(2).at("values").at("burr_in_view_share").is_null());
    EXPECT_THAT(items.at(3).at("why_not").get<std::string>(), HasSubstr("is no quantity"));
    EXPECT_THAT(metrics_csv(made.rows), HasSubstr("rating_item_points,Opened,2,\n"));
    EXPECT_THAT(made.html, HasSubstr("<b>2 of 7 points</b>Not reached: All gone; Seen (not decided); Of a"));
    EXPECT_THAT(made.html, HasSubstr("a book"));
    EXPECT_THAT(made.html, HasSubstr("cut with the burr in view = not measured"));
}

TEST_F(RatedSession, ShowsWhoUndoesTheWayToFullMarks) {
    const Rating rating{{.name = "Opened", .when = "removed_mm3 > 1"}};
    const Report clean = report(rating);
    EXPECT_THAT(clean.html, HasSubstr("<b>1 of 1 points</b>Every item is reached."));
    EXPECT_EQ(clean.json.at("rating").at("undos"), 0);
    const Report undone = report(rating, 3);
    EXPECT_EQ(undone.rating.points(), 1.0);
    EXPECT_EQ(undone.json.at("rating").at("undos"), 3);
    EXPECT_EQ(undone.json.at("rating").at("undone_mm3"), 3 * 64.0);
    EXPECT_THAT(undone.html, HasSubstr("<b class='undone'> after 3 undos of 192.0 mm³</b>"));
    EXPECT_EQ(undone.json.at("metrics").at("undos"), 3.0);
}

TEST_F(RatedSession, IsSilentWithoutARatingAndWithoutAnEnd) {
    const Report unrated = report({});
    EXPECT_FALSE(unrated.json.contains("rating"));
    EXPECT_FALSE(unrated.json.at("metrics").contains("rating_share"));
    EXPECT_THAT(unrated.html, Not(HasSubstr(" points</b>")));
    EXPECT_THAT(unrated.html, Not(HasSubstr("Rating")));
    EXPECT_THAT(unrated.html, Not(HasSubstr("Not rated")));
    const Report torn = report({{.name = "Opened", .when = "removed_mm3 > 1"}}, 0, false);
    EXPECT_TRUE(torn.rating.items.empty());
    EXPECT_THAT(torn.html, HasSubstr("<b>Not rated</b>"));
}

TEST_F(RatedSession, ShowsHostileItemsAsText) {
    const std::string hostile = "\"'><script src=x>";
    const Report made =
        report({{.name = hostile, .when = hostile, .source = hostile}, {.name = hostile, .when = ""}});
    EXPECT_THAT(made.html, Not(HasSubstr("<script")));
    EXPECT_EQ(made.rating.points(), 0.0);
}

TEST_F(RatedSession, HasEveryQuantityThatARatingMayAskFor) {
    // With every structure near and every possible row, each key of the table is a row's and each row's key
    // is in the table, except for those that judge the session.
    SessionMetrics metrics;
    metrics.motion.burr_in_view_share = 1.0;
    metrics.structures = {{.name = "nerve"}};
    metrics.near.structures = {{.name = "nerve"}};
    metrics.exposures = {{.name = "nerve"}};
    metrics.removal.by_tissue = {{.name = "bone"}};
    metrics.removal.by_burr = {{.name = "round"}};
    metrics.force.by_tissue = {{.name = "bone"}};
    metrics.force.by_burr = {{.name = "round"}};
    metrics.plan = PlanMetrics{};
    std::set<std::string> keys;
    for (const MetricRow& row : metric_rows(metrics)) keys.insert(row.key);
    for (const RatedQuantity& one : rated_quantities)
        if (one.of != RatedThing::region) {
            EXPECT_EQ(keys.erase(one.key), 1u) << one.key;
        }
    EXPECT_TRUE(keys.empty()) << *keys.begin();
}

}  // namespace
}  // namespace osteomill
