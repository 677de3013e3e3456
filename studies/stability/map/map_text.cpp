#include "studies/stability/map/map_text.h"

#include <fmt/format.h>

#include <stdexcept>

namespace osteomill::study {

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
    constexpr std::array names{"map", "bars", "real-device"};
    return names.at(static_cast<std::size_t>(part));
}

std::string name_of(MapScene scene) {
    return scene == MapScene::cutting ? "cutting" : "wall";
}

std::string name_of(MapGrip grip) {
    constexpr std::array names{"bare-arm", "light", "firm"};
    return names.at(static_cast<std::size_t>(grip));
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

std::string text_of(const MapPoint& point) {
    const std::string rubs =
        point.run.edge_n_per_mm > 0.0 ? fmt::format(", edges of {} N/mm", point.run.edge_n_per_mm) : "";
    return name_of(point.part) + ": " + text_of(point.run) + rubs;
}

nlohmann::ordered_json json_of(const MapSelection& selection) {
    nlohmann::ordered_json grips = nlohmann::ordered_json::array();
    for (const MapGrip grip : selection.grips) grips.push_back(name_of(grip));
    return {{"quick", selection.quick},
            {"methods", selection.methods},
            {"grips", grips},
            {"milling_rates_hz", selection.milling_rates_hz},
            {"delays_ticks", selection.delays_ticks},
            {"edge_forces", selection.has_edge_forces}};
}

void to_json(nlohmann::json& json, const MapOutcome& outcome) {
    json["is_stable"] = outcome.is_stable;
    for (const OutcomeNumber& number : outcome_numbers)
        json[std::string(number.name)] = outcome.*number.value;
}

void from_json(const nlohmann::json& json, MapOutcome& outcome) {
    outcome.is_stable = json.at("is_stable").get<bool>();
    for (const OutcomeNumber& number : outcome_numbers)
        outcome.*number.value = json.at(std::string(number.name)).get<double>();
}

}  // namespace osteomill::study
