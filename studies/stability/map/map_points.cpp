#include "studies/stability/map/map_points.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "simulation/cutting_force/reference_force.h"

namespace osteomill::study {

namespace {

/// How finely each axis is taken.
struct MapAxes {
    std::vector<CuttingCondition> conditions;
    std::vector<double> walls_n_per_mm;
    std::vector<double> milling_rates_hz;
    std::vector<int> delays_ticks;
};

MapAxes map_axes(bool quick) {
    if (quick)
        return {.conditions = cutting_conditions(true),
                .walls_n_per_mm = {0.1, 1.5},
                .milling_rates_hz = {100.0, 1000.0},
                .delays_ticks = {0, 1}};
    return {.conditions = cutting_conditions(false),
            .walls_n_per_mm = {0.1, 0.15, 0.22, 0.32, 0.47, 0.69, 1.0, 1.5},
            .milling_rates_hz = map_milling_rates_hz(),
            .delays_ticks = map_delays_ticks()};
}

MapAxes real_device_axes(bool quick) {
    const std::vector<CuttingCondition> all = cutting_conditions(quick);
    std::vector<CuttingCondition> every_other;
    for (std::size_t i = 0; i < all.size(); i += 2) every_other.push_back(all[i]);
    return {.conditions = every_other,
            .walls_n_per_mm = {1.5},
            .milling_rates_hz = {100.0, 1000.0},
            .delays_ticks = {0}};
}

MapCase cutting(const CuttingCondition& condition) {
    return {.method = {},
            .scene = MapScene::cutting,
            .spindle_rpm = condition.spindle_rpm,
            .depth_mm = condition.depth_mm,
            .relative_stiffness = condition.relative_stiffness};
}

std::vector<MapCase> scenes(const MapAxes& axes) {
    std::vector<MapCase> found;
    for (const CuttingCondition& condition : axes.conditions) found.push_back(cutting(condition));
    for (const double wall_n_per_mm : axes.walls_n_per_mm)
        found.push_back({.method = {}, .scene = MapScene::wall, .wall_n_per_mm = wall_n_per_mm});
    return found;
}

/// Every scene with every grip, rate and delay.
void add(std::vector<MapPoint>& points, MapPart part, const std::string& method,
         const std::vector<MapCase>& scenes, const MapAxes& axes) {
    for (const MapCase& scene : scenes)
        for (const MapGrip grip : map_grips())
            for (const double rate_hz : axes.milling_rates_hz)
                for (const int delay_ticks : axes.delays_ticks) {
                    MapCase run = scene;
                    run.method = method;
                    run.grip = grip;
                    run.milling_rate_hz = rate_hz;
                    run.delay_ticks = delay_ticks;
                    run.is_ideal_device = part != MapPart::real_device;
                    points.push_back({part, run});
                }
}

/// Bone of K_t = 230 N/mm^2, up to the burr fully immersed, up to one tick of delay.
void add_bars(std::vector<MapPoint>& points, bool quick) {
    MapAxes axes = map_axes(quick);
    axes.delays_ticks = {0, 1};
    std::vector<MapCase> slots;
    for (const double rpm : quick ? std::vector{5'000.0, 80'000.0}
                                  : std::vector{5'000.0, 10'000.0, 20'000.0, 40'000.0, 80'000.0})
        for (const double depth_mm : quick ? std::vector{0.25, 5.0} : std::vector{0.25, 1.0, 2.5, 5.0})
            slots.push_back(cutting({rpm, depth_mm, 1.0}));
    add(points, MapPart::bars, map_methods().front(), slots, axes);
}

/// As the tooth scene's burrs.
constexpr double edge_n_per_mm = 0.3;

/// Whether edges alone take no more than two thirds of the force that the scene's hand gives.
bool hand_gets_on(const MapCase& c) {
    constexpr double most_n = 1.0;
    const Burr burr{.cutting_coefficients_n_per_mm2 = glm::dvec3(0.0),
                    .edge_coefficients_n_per_mm = {c.edge_n_per_mm, c.edge_n_per_mm, 0.0}};
    const SteadyMotion motion{.burr = burr,
                              .position_mm = {0.0, 0.0, burr.radius_mm() - c.depth_mm},
                              .velocity_mm_per_s = {1.0, 0.0, 0.0}};
    const Quadrature quadrature{.kappa = 60, .psi = 180};
    return c.relative_stiffness * glm::length(mean_reference_force_n(motion, flat_bone(), quadrature)) <=
           most_n;
}

template <typename Value>
bool has(const std::vector<Value>& wanted, const Value& value) {
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), value) != wanted.end();
}

}  // namespace

const std::vector<std::string>& map_methods() {
    static const std::vector<std::string> methods{"implicit",
                                                  "virtual-coupling",
                                                  "hold",
                                                  "interpolate",
                                                  "sample-estimate-hold",
                                                  "sample-estimate-interpolate",
                                                  "corrected-sample-estimate-hold",
                                                  "hold+damper",
                                                  "interpolate+damper",
                                                  "hold+passivity",
                                                  "interpolate+passivity"};
    return methods;
}

const std::vector<MapGrip>& map_grips() {
    static const std::vector<MapGrip> grips{MapGrip::bare_arm, MapGrip::light, MapGrip::firm};
    return grips;
}

const std::vector<double>& map_milling_rates_hz() {
    static const std::vector<double> rates_hz{100.0, 300.0, 1000.0};
    return rates_hz;
}

const std::vector<int>& map_delays_ticks() {
    static const std::vector<int> delays_ticks{0, 1, 2, 3};
    return delays_ticks;
}

std::vector<CuttingCondition> cutting_conditions(bool quick) {
    // Neighbours differ in how they come to their resistance: that alone must decide.
    if (quick)
        return {{80'000.0, 0.1, 1.0}, {20'000.0, 0.1, 1.0}, {80'000.0, 3.5, 0.4},
                {20'000.0, 1.5, 1.0}, {20'000.0, 5.0, 1.0}, {5'000.0, 5.0, 1.0}};
    return {{80'000.0, 0.1, 1.0},  {40'000.0, 0.1, 0.7},  {80'000.0, 0.25, 0.7}, {80'000.0, 0.25, 1.0},
            {10'000.0, 0.1, 0.4},  {20'000.0, 0.1, 1.0},  {10'000.0, 0.1, 0.7},  {80'000.0, 0.75, 1.0},
            {20'000.0, 0.25, 1.0}, {80'000.0, 3.5, 0.4},  {80'000.0, 2.5, 0.7},  {10'000.0, 0.75, 0.4},
            {5'000.0, 0.5, 0.4},   {10'000.0, 0.75, 0.7}, {20'000.0, 1.5, 1.0},  {10'000.0, 2.5, 0.4},
            {40'000.0, 5.0, 1.0},  {10'000.0, 2.5, 0.7},  {20'000.0, 5.0, 1.0},  {5'000.0, 1.5, 1.0},
            {5'000.0, 5.0, 0.4},   {10'000.0, 5.0, 1.0},  {5'000.0, 3.5, 1.0},   {5'000.0, 5.0, 1.0}};
}

std::vector<MapPoint> map_points(const MapSelection& selection) {
    std::vector<MapPoint> points;
    for (const std::string& method : map_methods()) {
        const MapAxes axes = map_axes(selection.quick);
        add(points, MapPart::map, method, scenes(axes), axes);
    }
    add_bars(points, selection.quick);
    for (const std::string& method : map_methods()) {
        const MapAxes axes = real_device_axes(selection.quick);
        add(points, MapPart::real_device, method, scenes(axes), axes);
    }
    if (selection.has_edge_forces) {
        for (MapPoint& point : points) point.run.edge_n_per_mm = edge_n_per_mm;
        std::erase_if(points, [](const MapPoint& point) {
            return point.run.scene != MapScene::cutting || !hand_gets_on(point.run);
        });
    }
    std::erase_if(points, [&](const MapPoint& point) {
        return !has(selection.methods, point.run.method) || !has(selection.grips, point.run.grip) ||
               !has(selection.milling_rates_hz, point.run.milling_rate_hz) ||
               !has(selection.delays_ticks, point.run.delay_ticks);
    });
    return points;
}

}  // namespace osteomill::study
