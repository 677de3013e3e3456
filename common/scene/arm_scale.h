// The ratio of the patient's millimetres to an arm's. One of the arm is s of the patient's
// (DeviceMapping::scale). A force in newtons and a time are the same in both spaces, so a quantity's value in
// the patient's space is its value at the arm times
//
//     s      a length, a speed, an energy (mJ = N mm)
//     1/s    a stiffness (N/mm), a damping (N s/mm), an apparent mass (N s^2/mm = 1000 kg)
//
// since dF = K dx, F = B v and F = M dv/dt hold in both. Nothing else converts an arm's abilities.
#pragma once

namespace osteomill {

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
