#include "studies/stability/map/stability_study.h"

#include <stdexcept>

#include "analysis/output/study_run.h"
#include "studies/stability/map/map_summary.h"
#include "studies/stability/map/map_table.h"
#include "studies/stability/map/map_text.h"
#include "studies/stability/map/method_score.h"
#include "studies/stability/map/region_table.h"
#include "studies/stability/map/whole_map.h"

namespace osteomill::study {

namespace {

void write_results(const WholeMap& map, const StudyRun& run) {
    run.write(map_table_of(map), "map");
    run.write(summary_of(map), "map");
    run.write(region_table_of(map, MapScene::cutting), "regions_cutting");
    run.write(region_table_of(map, MapScene::wall), "regions_wall");
    run.write(region_rows_of(map), "region_rows");
    run.write(pareto_table_of(method_scores(map, MapPart::map, MapScene::cutting)), "pareto_cutting");
    run.write(pareto_table_of(method_scores(map, MapPart::map, MapScene::wall)), "pareto_wall");
    run.write(error_table_of(map), "errors");
    run.draw({"map_cutting"});
    // With edges that rub there is no wall, which the others compare with.
    if (!map.selection.has_edge_forces) run.draw({"map_wall", "map_pareto", "map_errors"});
    run.say("{}map.json, tables (CSV) and charts (SVG) are in {}", summary_text_of(map), run.out().string());
}

}  // namespace

void run_stability_study(const MapSelection& selection, const RunCase& run_case,
                         const std::filesystem::path& out, const StudySurroundings& surroundings) {
    require_charts_of(surroundings);
    WholeMap map{.selection = selection, .points = map_points(selection), .outcomes = {}};
    if (map.points.empty()) throw std::runtime_error("nothing of the map is selected");
    StudyRun run(out, surroundings);
    const auto planned = run.plan(
        map.points, [](const MapPoint& point) { return text_of(point); },
        [&](const MapPoint& point) { return run_case(point.run); });
    if (!run.perform()) return;
    map.outcomes = planned.outcomes();
    write_results(map, run);
}

}  // namespace osteomill::study
