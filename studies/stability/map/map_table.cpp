#include "studies/stability/map/map_table.h"

#include <algorithm>

#include "studies/stability/map/map_text.h"
#include "studies/stability/map/map_view.h"
#include "studies/stability/map/method_score.h"

namespace osteomill::study {

Table map_table_of(const WholeMap& map) {
    std::vector<std::string> columns{
        "part",          "method",          "scene",       "grip",     "milling_rate_hz",
        "delay_ticks",   "is_ideal_device", "spindle_rpm", "depth_mm", "relative_stiffness",
        "wall_n_per_mm", "is_stable"};
    for (const OutcomeNumber& number : outcome_numbers) columns.emplace_back(number.name);
    Table table(columns);
    for (std::size_t i = 0; i < map.points.size(); ++i) {
        const MapCase& c = map.points[i].run;
        std::vector<nlohmann::ordered_json> row{name_of(map.points[i].part),
                                                c.method,
                                                name_of(c.scene),
                                                name_of(c.grip),
                                                c.milling_rate_hz,
                                                c.delay_ticks,
                                                c.is_ideal_device,
                                                c.spindle_rpm,
                                                c.depth_mm,
                                                c.relative_stiffness,
                                                c.wall_n_per_mm,
                                                map.outcomes[i].is_stable};
        for (const OutcomeNumber& number : outcome_numbers) row.push_back(map.outcomes[i].*number.value);
        table.add(std::move(row));
    }
    return table;
}

Table error_table_of(const WholeMap& map) {
    const auto results = results_where(map, [](const MapPoint& point) {
        return point.part == MapPart::map && point.run.scene == MapScene::cutting &&
               point.run.milling_rate_hz == 1000.0 && point.run.delay_ticks == 0;
    });
    Table table({"number", "method", "grip", "resistance_n_s_per_m", "rms_error_percent", "stable"});
    for (const std::string& method : map_methods())
        for (const MapGrip grip : map_grips()) {
            std::vector<const MapOutcome*> curve;
            for (const MapResult& result : results)
                if (result.point.run.method == method && result.point.run.grip == grip)
                    curve.push_back(&result.outcome);
            std::stable_sort(curve.begin(), curve.end(), [](const MapOutcome* a, const MapOutcome* b) {
                return a->resistance_n_s_per_m < b->resistance_n_s_per_m;
            });
            for (const MapOutcome* outcome : curve)
                table.add({number_of(method), method, name_of(grip), outcome->resistance_n_s_per_m,
                           100.0 * rms_error(*outcome), outcome->is_stable});
        }
    return table;
}

}  // namespace osteomill::study
