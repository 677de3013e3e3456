// The points of the stability map: every coupling against every resistance, grip, milling rate and delay that
// a surgeon or an arm may bring. Always the same list in the same order; its length times the CPU time of a
// case (0.1 s) is what the study takes.
#pragma once

#include <string>
#include <vector>

#include "studies/stability/map/map_case.h"

namespace osteomill::study {

enum class MapPart {
    map,         ///< an ideal device: what the regions and shares are of
    bars,        ///< `implicit` over the range that it must hold, denser in depth and speed
    real_device  ///< a sample of the map on a device with encoder steps and friction
};

struct MapPoint {
    MapPart part = MapPart::map;
    MapCase run;

    bool operator==(const MapPoint&) const = default;
};

/// What is to be run of the map. An empty list leaves its axis whole.
struct MapSelection {
    bool quick = false;  ///< a coarser grid of every axis: a minute on two cores
    /// Cutting alone, by burrs whose edges rub, where a hand that may press with 1.5 N still gets on.
    bool has_edge_forces = false;
    std::vector<std::string> methods{};
    std::vector<MapGrip> grips{};
    std::vector<double> milling_rates_hz{};
    std::vector<int> delays_ticks{};

    bool operator==(const MapSelection&) const = default;
};

/// The couplings that are compared, names as of --coupling; the first is the one that the bars are for.
const std::vector<std::string>& map_methods();

/// The axes of the full map.
const std::vector<MapGrip>& map_grips();
const std::vector<double>& map_milling_rates_hz();
const std::vector<int>& map_delays_ticks();

/// A burr in a slot: resistance rises with depth and stiffness and falls with speed.
struct CuttingCondition {
    double spindle_rpm;
    double depth_mm;
    double relative_stiffness;
};

/// In ascending order of resistance, about as far apart on a logarithmic scale: 4 to 3500 N s/m.
std::vector<CuttingCondition> cutting_conditions(bool quick);

/// Empty where nothing of the map is selected.
std::vector<MapPoint> map_points(const MapSelection& selection);

}  // namespace osteomill::study
