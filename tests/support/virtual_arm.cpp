#include "tests/support/virtual_arm.h"

#include <cmath>
#include <numbers>

namespace osteomill::testing {

glm::dvec3 angles_at(const ArmProfile& profile, const glm::dvec3& position_mm) {
    const glm::dvec3 tip_m = 0.001 * position_mm + profile.origin_m;
    const double reach_m = std::hypot(tip_m.x, tip_m.y);
    const double height_m = tip_m.z - profile.lengths_m.x;
    const double lb = profile.lengths_m.y;
    const double lc = profile.lengths_m.z;
    // With C' = pi - C the arm is two links whose angles are counted from the vertical.
    const double far_m = std::hypot(reach_m, height_m);
    const double tilt = std::atan2(reach_m, height_m);
    const double at_base = std::acos((lb * lb + far_m * far_m - lc * lc) / (2.0 * lb * far_m));
    const double at_tip = std::acos((lc * lc + far_m * far_m - lb * lb) / (2.0 * lc * far_m));
    return {std::atan2(tip_m.y, tip_m.x), tilt - at_base, std::numbers::pi - (tilt + at_tip)};
}

std::array<int, 3> counts_at(const ArmProfile& profile, const glm::dvec3& angles_rad) {
    std::array<int, 3> counts{};
    for (int i = 0; i < 3; ++i) {
        const ArmJoint& joint = profile.joints[static_cast<std::size_t>(i)];
        const double rad_per_count =
            joint.direction * 2.0 * std::numbers::pi / joint.counts_per_rev * joint.capstan_m / joint.body_m;
        counts[static_cast<std::size_t>(i)] = static_cast<int>(std::lround(angles_rad[i] / rad_per_count));
    }
    return counts;
}

VirtualArm::VirtualArm(const ArmProfile& profile)
    : profile_(profile), kinematics_(profile), counts_(profile.home_counts) {
    power_up();
}

void VirtualArm::move_to(const glm::dvec3& position_mm) {
    counts_ = counts_at(profile_, angles_at(profile_, position_mm));
}

void VirtualArm::power_up() {
    for (std::size_t i = 0; i < 3; ++i) offsets_[i] = -counts_[i];
    currents_ma_ = {};
    asks_ = false;
}

std::array<std::uint8_t, 14> VirtualArm::report() const {
    std::array<int, 7> fields{};
    for (std::size_t i = 0; i < 3; ++i) fields[i] = counts_[i] + offsets_[i];
    fields[3] = is_switch_pressed_ ? 10'000 : 0;
    fields[6] = asks_ ? 1 : 0;
    std::array<std::uint8_t, 14> bytes{};
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const auto bits = static_cast<std::uint16_t>(fields[i]);
        bytes[2 * i] = static_cast<std::uint8_t>(bits & 0xFF);
        bytes[2 * i + 1] = static_cast<std::uint8_t>(bits >> 8);
    }
    return bytes;
}

void VirtualArm::take(std::span<const std::uint8_t> report, double now_s) {
    if (report.size() != 14) return;
    const auto field = [&](std::size_t i) {
        return static_cast<std::int16_t>(static_cast<std::uint16_t>(report[2 * i] | report[2 * i + 1] << 8));
    };
    taken_s_ = now_s;
    if (field(3) != 1) {
        for (std::size_t i = 0; i < 3; ++i) currents_ma_[i] = field(i);
        return;
    }
    for (std::size_t i = 0; i < 3; ++i) offsets_[i] = field(4 + i) - counts_[i];
    currents_ma_ = {};
    asks_ = false;
    ++calibrations_;
}

glm::dvec3 VirtualArm::force_n(double now_s) const {
    if (now_s - taken_s_ > watchdog_s) return glm::dvec3(0.0);
    const glm::dvec3 currents_a = 0.001 * glm::dvec3(currents_ma_[0], currents_ma_[1], currents_ma_[2]);
    return kinematics_.force_n(kinematics_.angles_rad(counts_), currents_a);
}

}  // namespace osteomill::testing
