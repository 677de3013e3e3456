// The milling force at the rate of the milling loop as CSV, one line a step: with --force-model
// milling-instants at 10 kHz, the force within the tooth period.
//
// Columns: t_s; burr_*_mm, patient LPS; force_*_n, of the bone on the burr during the step, patient axes;
// removed_mm3 by the step; spindle 0 or 1.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <glm/vec3.hpp>
#include <string>

namespace osteomill {

struct MillingSample {
    double time_s = 0.0;
    glm::dvec3 burr_mm{0.0};
    glm::dvec3 force_n{0.0};
    double removed_mm3 = 0.0;
    bool spindle_on = false;

    static std::string header_line();
    /// 1.6 s of steps at 10 kHz.
    static constexpr std::size_t capacity = 16384;
    void append_to(fmt::memory_buffer& text) const;
};

}  // namespace osteomill
