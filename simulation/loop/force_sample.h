// The recording of forces and depth as CSV, one line a haptic tick.
//
// Columns: t_s; hand_*_mm and burr_*_mm, patient LPS; force_*_n, on the hand, patient axes; depth_mm, of the
// burr's lowest point below where it first met bone, along the spindle axis of that moment, 0 before;
// removed_mm3 since the start; spindle 0 or 1; fault, the number of a Fault, 0 while all is well. Where a
// burr of the scene has a shank also shank_torque_*_n_mm, of bone on the shank about the burr's centre,
// patient axes.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>

#include "simulation/safety/fault.h"

namespace osteomill {

struct ForceSample {
    double time_s = 0.0;
    glm::dvec3 hand_mm{0.0};
    glm::dvec3 burr_mm{0.0};
    glm::dvec3 force_n{0.0};
    double depth_mm = 0.0;
    double removed_mm3 = 0.0;
    bool spindle_on = false;
    Fault fault = Fault::none;
    std::optional<glm::dvec3> shank_torque_n_mm{};

    static constexpr const char* header_line =
        "t_s,hand_x_mm,hand_y_mm,hand_z_mm,burr_x_mm,burr_y_mm,burr_z_mm,force_x_n,force_y_n,force_z_n,"
        "depth_mm,removed_mm3,spindle,fault\n";
    static constexpr const char* header_line_with_shank =
        "t_s,hand_x_mm,hand_y_mm,hand_z_mm,burr_x_mm,burr_y_mm,burr_z_mm,force_x_n,force_y_n,force_z_n,"
        "depth_mm,removed_mm3,spindle,fault,shank_torque_x_n_mm,shank_torque_y_n_mm,shank_torque_z_n_mm\n";
    /// 8 s of ticks.
    static constexpr std::size_t capacity = 8192;
    void append_to(fmt::memory_buffer& text) const;
};

}  // namespace osteomill
