// Force and depth against time, from the log of a session.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

#include "analysis/output/cases/json_values.h"

namespace osteomill::study {

struct RecordedForce {
    double time_s = 0.0;
    glm::dvec3 burr_mm{0.0};  ///< patient LPS
    glm::dvec3 force_n{0.0};  ///< patient axes
    double removed_mm3 = 0.0;
    double depth_mm = 0.0;  ///< of the burr's lowest point below the surface; the log does not say, 0
};

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RecordedForce, time_s, burr_mm, force_n, removed_mm3, depth_mm)

using ForceRecord = std::vector<RecordedForce>;

/// Reads what ForceLog wrote (force_log.h). Throws std::runtime_error naming file and line.
ForceRecord read_force_log(const std::filesystem::path& file);

}  // namespace osteomill::study
