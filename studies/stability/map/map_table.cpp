#include "studies/stability/map/map_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "studies/stability/map/map_text.h"
#include "studies/stability/map/map_view.h"
#include "studies/stability/map/method_score.h"

namespace osteomill::study {

std::string map_csv_of(const WholeMap& map) {
    std::string csv =
        "part,method,scene,grip,milling_rate_hz,delay_ticks,is_ideal_device,spindle_rpm,depth_mm,"
        "relative_stiffness,wall_n_per_mm,is_stable";
    for (const OutcomeNumber& number : outcome_numbers) csv += fmt::format(",{}", number.name);
    csv += '\n';
    for (std::size_t i = 0; i < map.points.size(); ++i) {
        const MapCase& c = map.points[i].run;
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}", name_of(map.points[i].part), c.method,
                           name_of(c.scene), name_of(c.grip), c.milling_rate_hz, c.delay_ticks,
                           c.is_ideal_device ? 1 : 0, c.spindle_rpm, c.depth_mm, c.relative_stiffness,
                           c.wall_n_per_mm, map.outcomes[i].is_stable ? 1 : 0);
        for (const OutcomeNumber& number : outcome_numbers)
            csv += fmt::format(",{:.6g}", map.outcomes[i].*number.value);
        csv += '\n';
    }
    return csv;
}

std::string error_csv_of(const WholeMap& map) {
    const auto results = results_where(map, [](const MapPoint& point) {
        return point.part == MapPart::map && point.run.scene == MapScene::cutting &&
               point.run.milling_rate_hz == 1000.0 && point.run.delay_ticks == 0;
    });
    std::string csv = "number,method,grip,resistance_n_s_per_m,rms_error_percent,stable\n";
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
                csv += fmt::format("{},{},{},{:.6g},{:.6g},{}\n", number_of(method), method, name_of(grip),
                                   outcome->resistance_n_s_per_m, 100.0 * rms_error(*outcome),
                                   outcome->is_stable ? 1 : 0);
        }
    return csv;
}

}  // namespace osteomill::study
