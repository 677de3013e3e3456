#include "studies/stability/map/stability_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <stdexcept>

#include "analysis/output/study_run.h"
#include "analysis/output/sweep.h"
#include "common/program/progress.h"
#include "studies/stability/map/case_file.h"
#include "studies/stability/map/map_summary.h"
#include "studies/stability/map/map_table.h"
#include "studies/stability/map/map_text.h"
#include "studies/stability/map/merge.h"
#include "studies/stability/map/method_score.h"
#include "studies/stability/map/region_table.h"

namespace osteomill::study {

namespace {

MapOutcome run_named(const MapCase& c, const RunCase& run) {
    try {
        return run(c);
    } catch (const std::exception& error) {
        throw std::runtime_error("case '" + text_of(c) + "': " + error.what());
    }
}

void write_results(const WholeMap& map, const std::filesystem::path& out,
                   const StudySurroundings& surroundings) {
    const StudyRun run(out, surroundings);
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
    run.say("{}map.json, tables (CSV) and charts (SVG) are in {}", summary_text_of(map), out.string());
}

}  // namespace

void run_stability_study(const StabilityStudyOptions& options, const RunCase& run,
                         const StudySurroundings& surroundings) {
    const std::vector<MapPoint> points = map_points(options.selection);
    if (points.empty()) throw std::runtime_error("nothing of the map is selected");
    const std::filesystem::path file = case_file_of(options.shard, options.out);
    {
        CaseFileWriter writer(file, options.selection, points, options.shard);
        std::vector<std::size_t> to_do = cases_of(options.shard, points);
        const std::size_t all = to_do.size();
        std::erase_if(to_do, [&](std::size_t index) { return writer.done_before().contains(index); });
        const std::size_t done_before = all - to_do.size();
        if (done_before > 0)
            surroundings.said << fmt::format("{} of {} cases are done in {}\n", done_before, all,
                                             file.string());
        ProgressLine line(surroundings.progress, surroundings.is_terminal, "cases");
        const auto report = [&](std::size_t done) {
            line.report(static_cast<double>(done) / static_cast<double>(all));
        };
        report(done_before);
        std::size_t done = done_before;
        sweep(
            to_do.size(), options.jobs, [&](std::size_t i) { return run_named(points[to_do[i]].run, run); },
            [&](std::size_t i, const MapOutcome& outcome) {
                writer.append(to_do[i], outcome);
                report(++done);
            });
    }
    if (options.shard.of == 1)
        write_results(merge({file}), options.out, surroundings);
    else
        surroundings.said << fmt::format("part {} of {} is in {}; join the parts with --merge\n",
                                         options.shard.number, options.shard.of, file.string());
}

void merge_stability_study(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& out,
                           const StudySurroundings& surroundings) {
    write_results(merge(parts), out, surroundings);
}

}  // namespace osteomill::study
