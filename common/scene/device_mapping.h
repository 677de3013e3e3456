// The mapping from the device's space to the patient's: p_patient = rotation * (scale * p_device) + offset.
// Directions turn; forces turn back and are not scaled.
#pragma once

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtc/quaternion.hpp>
#include <glm/gtx/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "common/scene/scene.h"

namespace osteomill {

inline glm::dvec3 position_in_patient_mm(const DeviceMapping& mapping,
                                         const glm::dvec3& position_in_device_mm) {
    return mapping.rotation * (mapping.scale * position_in_device_mm) + mapping.offset_mm;
}

inline glm::dvec3 position_in_device_mm(const DeviceMapping& mapping, const glm::dvec3& position_in_patient) {
    return glm::transpose(mapping.rotation) * (position_in_patient - mapping.offset_mm) / mapping.scale;
}

/// A unit vector, such as the spindle's axis.
inline glm::dvec3 direction_in_patient(const DeviceMapping& mapping, const glm::dvec3& direction_in_device) {
    return mapping.rotation * direction_in_device;
}

inline glm::dvec3 direction_in_device(const DeviceMapping& mapping, const glm::dvec3& direction) {
    return glm::transpose(mapping.rotation) * direction;
}

inline glm::dvec3 velocity_in_patient_mm_per_s(const DeviceMapping& mapping,
                                               const glm::dvec3& velocity_in_device) {
    return mapping.rotation * (mapping.scale * velocity_in_device);
}

inline glm::dvec3 force_in_device_n(const DeviceMapping& mapping, const glm::dvec3& force_in_patient_n) {
    return glm::transpose(mapping.rotation) * force_in_patient_n;
}

/// The mapping that brings the tool to `wanted` while the device is at `position_in_device_mm` with its axis
/// at `axis_in_device`: a turn by the least possible angle, and a shift.
inline DeviceMapping placed(const DeviceMapping& mapping, const glm::dvec3& position_in_device_mm,
                            const glm::dvec3& axis_in_device, const ToolPose& wanted) noexcept {
    const glm::dvec3 from = direction_in_patient(mapping, axis_in_device);
    DeviceMapping result = mapping;
    result.rotation = glm::mat3_cast(glm::rotation(from, wanted.spindle_axis)) * mapping.rotation;
    result.offset_mm = wanted.position_mm - result.rotation * (result.scale * position_in_device_mm);
    return result;
}

/// The ratio of the patient's millimetres to an arm's. One of the arm is s of the patient's
/// (DeviceMapping::scale). A force in newtons and a time are the same in both spaces, so a quantity's value
/// in the patient's space is its value at the arm times
///
///     s      a length, a speed, an energy (mJ = N mm)
///     1/s    a stiffness (N/mm), a damping (N s/mm), an apparent mass (N s^2/mm = 1000 kg)
///
/// since dF = K dx, F = B v and F = M dv/dt hold in both. Nothing else converts an arm's abilities.
class ArmScale {
  public:
    /// For spaces of the same size.
    constexpr ArmScale() = default;
    /// `patient_mm_per_device_mm` > 0.
    constexpr explicit ArmScale(double patient_mm_per_device_mm) : ratio_(patient_mm_per_device_mm) {}

    // Each takes the value at the arm, and returns the value in the patient's space.
    constexpr double length_mm(double at_arm) const { return ratio_ * at_arm; }
    constexpr double speed_mm_per_s(double at_arm) const { return ratio_ * at_arm; }
    constexpr double energy_mj(double at_arm) const { return ratio_ * at_arm; }
    constexpr double stiffness_n_per_mm(double at_arm) const { return at_arm / ratio_; }
    constexpr double damping_n_s_per_mm(double at_arm) const { return at_arm / ratio_; }
    constexpr double mass_kg(double at_arm) const { return at_arm / ratio_; }

  private:
    double ratio_ = 1.0;
};

}  // namespace osteomill
