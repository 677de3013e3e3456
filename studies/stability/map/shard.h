// A part of the map for one process among several, on one machine or many.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "studies/stability/map/map_points.h"

namespace osteomill::study {

struct Shard {
    std::size_t number = 1;  ///< 1 .. of
    std::size_t of = 1;

    bool operator==(const Shard&) const = default;
};

/// "2/8". Throws std::invalid_argument for anything but I/N with 1 <= I <= N.
Shard shard_named(const std::string& text);

/// Indices into `points` of the cases of a part: every case is in exactly one part, and the parts are as long
/// as each other but for one case. They are drawn as by lot, always the same, so that each part has its share
/// of what takes long and the first cases of a part tell how long the rest will take.
std::vector<std::size_t> cases_of(const Shard& shard, const std::vector<MapPoint>& points);

/// Of the list: changes when a case, the order or what is measured of a case changes. Hexadecimal.
std::string fingerprint_of(const std::vector<MapPoint>& points);

}  // namespace osteomill::study
