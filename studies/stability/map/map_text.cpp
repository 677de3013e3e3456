#include "studies/stability/map/map_text.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

namespace osteomill::study {

using nlohmann::json;
using nlohmann::ordered_json;

const std::array<OutcomeNumber, 13> outcome_numbers{{
    {"resistance_n_s_per_m", &MapOutcome::resistance_n_s_per_m},
    {"truth_mean_n", &MapOutcome::truth_mean_n},
    {"limit_cycle_n", &MapOutcome::limit_cycle_n},
    {"injected_mj", &MapOutcome::injected_mj},
    {"rms_error_n", &MapOutcome::rms_error_n},
    {"mean_error_n", &MapOutcome::mean_error_n},
    {"peak_n", &MapOutcome::peak_n},
    {"largest_jump_n", &MapOutcome::largest_jump_n},
    {"depth_error_mm", &MapOutcome::depth_error_mm},
    {"removed_mm3", &MapOutcome::removed_mm3},
    {"max_residual_n", &MapOutcome::max_residual_n},
    {"fallbacks", &MapOutcome::fallbacks},
    {"energy_faults", &MapOutcome::energy_faults},
}};

std::string name_of(MapPart part) {
    switch (part) {
        case MapPart::map:
            return "map";
        case MapPart::bars:
            return "bars";
        case MapPart::real_device:
            return "real-device";
    }
    return "unknown";
}

std::string name_of(MapScene scene) {
    return scene == MapScene::cutting ? "cutting" : "wall";
}

std::string name_of(MapGrip grip) {
    switch (grip) {
        case MapGrip::bare_arm:
            return "bare-arm";
        case MapGrip::light:
            return "light";
        case MapGrip::firm:
            return "firm";
    }
    return "unknown";
}

MapGrip grip_named(const std::string& name) {
    for (const MapGrip grip : map_grips())
        if (name_of(grip) == name) return grip;
    throw std::invalid_argument("no grip is called '" + name + "'");
}

std::string text_of(const MapCase& c) {
    const std::string scene = c.scene == MapScene::cutting
                                  ? fmt::format("cutting {} mm deep at {} rpm in bone of stiffness {}",
                                                c.depth_mm, c.spindle_rpm, c.relative_stiffness)
                                  : fmt::format("wall of {} N/mm", c.wall_n_per_mm);
    return fmt::format("{}, {}, {}, {} Hz, {} ticks late, {} device", c.method, scene, name_of(c.grip),
                       c.milling_rate_hz, c.delay_ticks, c.is_ideal_device ? "ideal" : "real");
}

ordered_json json_of(const MapPoint& point) {
    const MapCase& c = point.run;
    ordered_json row{{"part", name_of(point.part)},
                     {"method", c.method},
                     {"scene", name_of(c.scene)},
                     {"grip", name_of(c.grip)},
                     {"milling_rate_hz", c.milling_rate_hz},
                     {"delay_ticks", c.delay_ticks},
                     {"is_ideal_device", c.is_ideal_device},
                     {"spindle_rpm", c.spindle_rpm},
                     {"depth_mm", c.depth_mm},
                     {"relative_stiffness", c.relative_stiffness},
                     {"wall_n_per_mm", c.wall_n_per_mm}};
    if (c.edge_n_per_mm != 0.0) row["edge_n_per_mm"] = c.edge_n_per_mm;
    return row;
}

ordered_json json_of(const MapSelection& selection) {
    ordered_json grips = ordered_json::array();
    for (const MapGrip grip : selection.grips) grips.push_back(name_of(grip));
    return {{"quick", selection.quick},
            {"methods", selection.methods},
            {"grips", grips},
            {"milling_rates_hz", selection.milling_rates_hz},
            {"delays_ticks", selection.delays_ticks},
            {"edge_forces", selection.has_edge_forces}};
}

MapSelection selection_of(const json& from) {
    MapSelection selection{.quick = from.at("quick").get<bool>(),
                           .has_edge_forces = from.value("edge_forces", false),
                           .methods = from.at("methods").get<std::vector<std::string>>(),
                           .milling_rates_hz = from.at("milling_rates_hz").get<std::vector<double>>(),
                           .delays_ticks = from.at("delays_ticks").get<std::vector<int>>()};
    for (const auto& grip : from.at("grips")) selection.grips.push_back(grip_named(grip.get<std::string>()));
    return selection;
}

ordered_json json_of(const MapOutcome& outcome) {
    ordered_json out{{"is_stable", outcome.is_stable}};
    for (const OutcomeNumber& number : outcome_numbers) out[std::string(number.name)] = outcome.*number.value;
    return out;
}

MapOutcome outcome_of(const json& from) {
    MapOutcome outcome{.is_stable = from.at("is_stable").get<bool>()};
    for (const OutcomeNumber& number : outcome_numbers) {
        const auto& value = from.at(std::string(number.name));
        outcome.*number.value =
            value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
    }
    return outcome;
}

}  // namespace osteomill::study
