// Summary of the map, in numbers.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "studies/stability/map/whole_map.h"

namespace osteomill::study {

/// "cases", "selection", "fingerprint"; "methods": for each, by scene, the share of the range that is stable,
/// the same by grip, milling rate and delay, up to which resistance (or wall) all of 1000 Hz without delay is
/// stable, errors where stable, and beside it the share on a real device; "bars" of `implicit`.
nlohmann::ordered_json summary_of(const WholeMap& map);

/// The same for a reader: a line a method, a line a bar.
std::string summary_text_of(const WholeMap& map);

}  // namespace osteomill::study
