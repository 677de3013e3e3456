// Profile of one haptic arm: its geometry, motors, encoders, limits. Read from
// TOML; shipped ones are in devices/profiles.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/device/measured_arm.h"

namespace osteomill {

/// Which USB device it is.
struct HidIdentity {
    std::uint16_t vendor_id = 0x1234;
    std::uint16_t product_id = 0x0006;
    std::uint16_t usage_page = 0xFFAB;
    std::uint16_t usage = 0x0200;

    bool operator==(const HidIdentity&) const = default;
};

/// A motor with its encoder, a cable on a capstan, and the body that it turns.
struct ArmJoint {
    double capstan_m = 0.0;
    double body_m = 0.0;  ///< diameters, both
    int counts_per_rev = 0;
    double torque_constant_nm_per_a = 0.0;
    double direction = 1.0;  ///< -1 where motor and body are aligned, else +1
};

/// Three encoders that tell how the stylus is held.
struct StylusEncoders {
    std::array<int, 3> counts_per_rev{};     ///< for the counters d, e, f
    std::array<double, 3> directions{};      ///< +1 or -1
    glm::dvec3 spindle_axis{1.0, 0.0, 0.0};  ///< unit, from tip to shank, in the stylus
};

/// How the counters are set to the position of the arm.
enum class CalibrationMethod {
    by_switch,   ///< the device asks, while somebody holds the arm at its calibration position
    at_power_up  ///< it was there when it was plugged in
};

/// The use of the switch on the stylus.
enum class SwitchUse { pedal, pedal_and_clutch };

struct ArmProfile {
    std::string name;
    HidIdentity usb;
    std::array<ArmJoint, 3> joints;
    glm::dvec3 lengths_m{0.0};  ///< L_a, L_b, L_c
    glm::dvec3 origin_m{0.0};
    double apparent_mass_kg = 0.1;
    CalibrationMethod calibration = CalibrationMethod::by_switch;
    std::array<int, 3> home_counts{};  ///< at the calibration position
    double max_force_n = 0.0;
    double max_stiffness_n_per_m = 0.0;
    double max_current_a = 0.0;
    SwitchUse switch_use = SwitchUse::pedal;
    std::optional<StylusEncoders> stylus;   ///< none: the spindle's direction is fixed
    glm::dvec3 fixed_axis{0.0, 0.0, 1.0};   ///< unit, device space; the axis in that case
    std::optional<MeasuredArm> measured{};  ///< what was measured on this very arm
};

// Arm profiles as TOML, strictly read: a missing, misspelt or impossible key is an error with file and line.

/// Reads a profile; `name` stands for the file in errors. Throws SceneError (common/scene/scene_file.h) with
/// one line: file, line, key, what would be right.
ArmProfile parse_arm_profile(std::string_view toml, const std::string& name);

/// The texts of devices/profiles/*.toml, compiled in so that their names work wherever the program lies.
struct ShippedProfile {
    std::string_view name;
    std::string_view toml;
};

std::span<const ShippedProfile> shipped_profiles();

/// The profiles that are built in, from devices/*.toml.
std::vector<std::string> shipped_profile_names();

/// The text of one; as load_arm_profile finds it.
std::string arm_profile_text(const std::string& name_or_file);

/// A shipped profile by its name, or a file by its path (which ends in .toml). Throws SceneError, or
/// std::runtime_error if there is neither, naming the shipped ones.
ArmProfile load_arm_profile(const std::string& name_or_file);

}  // namespace osteomill
