// Between device space and patient LPS, by the scene's DeviceMapping: p_patient = R (s p_device) + offset.
// Directions turn only; velocities turn and scale; forces come back turned, unscaled.
#pragma once

#include <glm/matrix.hpp>

#include "common/scene/scene.h"

namespace osteomill {

inline glm::dvec3 position_to_patient(const DeviceMapping& mapping, const glm::dvec3& device_mm) {
    return mapping.rotation * (mapping.scale * device_mm) + mapping.offset_mm;
}
inline glm::dvec3 position_to_device(const DeviceMapping& mapping, const glm::dvec3& patient_mm) {
    return glm::transpose(mapping.rotation) * (patient_mm - mapping.offset_mm) / mapping.scale;
}
inline glm::dvec3 velocity_to_patient(const DeviceMapping& mapping, const glm::dvec3& device_mm_per_s) {
    return mapping.rotation * (mapping.scale * device_mm_per_s);
}
inline glm::dvec3 direction_to_patient(const DeviceMapping& mapping, const glm::dvec3& device_direction) {
    return mapping.rotation * device_direction;
}
inline glm::dvec3 direction_to_device(const DeviceMapping& mapping, const glm::dvec3& patient_direction) {
    return glm::transpose(mapping.rotation) * patient_direction;
}
inline glm::dvec3 force_to_device(const DeviceMapping& mapping, const glm::dvec3& patient_n) {
    return glm::transpose(mapping.rotation) * patient_n;
}

}  // namespace osteomill
