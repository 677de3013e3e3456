// The map's values as text: names for options and tables, JSON for files, a line for messages.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "studies/stability/map/map_outcome.h"
#include "studies/stability/map/map_points.h"

namespace osteomill::study {

std::string name_of(MapPart part);
std::string name_of(MapScene scene);
std::string name_of(MapGrip grip);
/// Throws std::invalid_argument for a name that no grip has.
MapGrip grip_named(const std::string& name);

/// "hold, cutting 1 mm deep at 10000 rpm in bone of 1, light, 1000 Hz, 0 ticks late".
std::string text_of(const MapCase& c);

/// The same with the part of the map, and of what rubs how much.
std::string text_of(const MapPoint& point);

nlohmann::ordered_json json_of(const MapSelection& selection);

/// The numbers of an outcome, by name.
struct OutcomeNumber {
    std::string_view name;
    double MapOutcome::*value;
};
extern const std::array<OutcomeNumber, 13> outcome_numbers;

void to_json(nlohmann::json& json, const MapOutcome& outcome);
void from_json(const nlohmann::json& json, MapOutcome& outcome);

}  // namespace osteomill::study
