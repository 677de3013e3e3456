// A point of the stability map: a scene, a hand, and the coupling between them. Plain values; a run gives a
// MapOutcome (map_run.h).
#pragma once

#include <string>

namespace osteomill::study {

enum class MapScene {
    cutting,  ///< a 5 mm burr at the end of the slot that it has cut, fed on along it
    wall      ///< the spindle is off and the burr is pressed on the bone
};

/// The grip on the arm, from none to a firm hand.
enum class MapGrip {
    bare_arm,  ///< 0.5 N s/m and a steady push, no hand; cutting, it slides on a plane
    light,     ///< hand_and_arm.h
    firm       ///< hand_and_arm.h
};

struct MapCase {
    std::string method;  ///< as of --coupling
    MapScene scene = MapScene::cutting;
    MapGrip grip = MapGrip::light;
    double milling_rate_hz = 1000.0;
    int delay_ticks = 0;  ///< haptic ticks from a reading of the device to its force, beyond the loop's own
    bool feed_forward = false;    ///< of bone's change, of a method that has one
    bool is_ideal_device = true;  ///< no encoder steps and no Coulomb friction: they hide limit cycles

    double spindle_rpm = 10'000.0;    ///< cutting
    double depth_mm = 1.0;            ///< cutting: the burr's lowest point's, up to its diameter
    double relative_stiffness = 1.0;  ///< cutting: the bone's, 1 = that of K_t = 230 N/mm^2
    double edge_n_per_mm = 0.0;       ///< cutting: K_te and K_re of edges that rub
    double wall_n_per_mm = 1.5;       ///< wall: stiffest spring that the device claims to render

    bool operator==(const MapCase&) const = default;
};

}  // namespace osteomill::study
