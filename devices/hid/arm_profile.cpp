#include "devices/hid/arm_profile.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "common/scene/nearest_name.h"
#include "common/scene/scene_file.h"
#include "common/scene/toml_reader.h"
#include "common/scene/toml_text.h"
#include "devices/measured/measured_profile.h"

namespace osteomill {

namespace {

// Anything beyond these is a slip of the unit: an arm stands on a desk.
constexpr AllowedRange length_range_m{0.01, 2.0};
constexpr AllowedRange diameter_range_m{0.001, 1.0};
constexpr AllowedRange torque_constant_range{0.001, 5.0};
constexpr AllowedRange force_range_n{0.1, 40.0};
constexpr AllowedRange stiffness_range_n_per_m{10.0, 20'000.0};
/// The most current of this family's amplifiers is 3 A (full scale).
constexpr AllowedRange current_range_a{0.01, 3.0};
constexpr AllowedRange mass_range_kg{0.005, 5.0};
constexpr std::int64_t most_counts = 32'767;  // the report's int16
constexpr std::int64_t most_counts_per_rev = 1'000'000;

double number(TomlReader& reader, std::string_view key, const AllowedRange& range) {
    return required(reader, key, reader.number(key, range));
}

std::optional<std::array<int, 3>> whole_numbers(TomlReader& reader, std::string_view key, double most) {
    const std::optional<glm::dvec3> values = reader.vector(key);
    if (!values) return std::nullopt;
    std::array<int, 3> result{};
    for (int i = 0; i < 3; ++i) {
        const double value = (*values)[i];
        if (value != std::round(value) || std::abs(value) > most)
            reader.fail(key,
                        fmt::format("'{}' must be three whole numbers within -{} to {}", key, most, most));
        result[static_cast<std::size_t>(i)] = static_cast<int>(value);
    }
    return result;
}

std::uint16_t usb_number(TomlReader& reader, std::string_view key, std::uint16_t otherwise) {
    return static_cast<std::uint16_t>(reader.whole_number(key, 0, 0xFFFF).value_or(otherwise));
}

HidIdentity read_usb(TomlReader reader) {
    const HidIdentity usual;
    const HidIdentity identity{.vendor_id = usb_number(reader, "vendor_id", usual.vendor_id),
                               .product_id = usb_number(reader, "product_id", usual.product_id),
                               .usage_page = usb_number(reader, "usage_page", usual.usage_page),
                               .usage = usb_number(reader, "usage", usual.usage)};
    reader.refuse_other_keys();
    return identity;
}

double direction(TomlReader& reader, std::string_view key) {
    const std::int64_t value = required(reader, key, reader.whole_number(key, -1, 1));
    if (value == 0) reader.fail(key, fmt::format("'{}' must be 1 or -1", key));
    return static_cast<double>(value);
}

ArmJoint read_joint(TomlReader& reader) {
    const ArmJoint joint{
        .capstan_m = number(reader, "capstan_m", diameter_range_m),
        .body_m = number(reader, "body_m", diameter_range_m),
        .counts_per_rev = static_cast<int>(required(
            reader, "counts_per_rev", reader.whole_number("counts_per_rev", 1, most_counts_per_rev))),
        .torque_constant_nm_per_a = number(reader, "torque_constant_nm_per_a", torque_constant_range),
        .direction = direction(reader, "direction")};
    reader.refuse_other_keys();
    return joint;
}

void read_arm(TomlReader reader, ArmProfile& profile) {
    profile.lengths_m = required(reader, "lengths_m", reader.vector("lengths_m"));
    for (int i = 0; i < 3; ++i) {
        if (profile.lengths_m[i] < length_range_m.low || profile.lengths_m[i] > length_range_m.high)
            reader.fail("lengths_m", fmt::format("'lengths_m' must be three lengths of {} to {} m",
                                                 length_range_m.low, length_range_m.high));
    }
    profile.origin_m = reader.vector("origin_m").value_or(glm::dvec3(0.0));
    if (!(glm::length(profile.origin_m) <= length_range_m.high))
        reader.fail("origin_m",
                    fmt::format("'origin_m' lies more than {} m from the arm", length_range_m.high));
    profile.apparent_mass_kg =
        reader.number("apparent_mass_kg", mass_range_kg).value_or(profile.apparent_mass_kg);
    reader.refuse_other_keys();
}

void read_calibration(TomlReader reader, ArmProfile& profile) {
    const std::size_t method = required(reader, "method", reader.choice("method", {"switch", "power-up"}));
    profile.calibration = method == 0 ? CalibrationMethod::by_switch : CalibrationMethod::at_power_up;
    profile.home_counts =
        required(reader, "counts", whole_numbers(reader, "counts", static_cast<double>(most_counts)));
    reader.refuse_other_keys();
}

void read_limits(TomlReader reader, ArmProfile& profile) {
    profile.max_force_n = number(reader, "max_force_n", force_range_n);
    profile.max_stiffness_n_per_m = number(reader, "max_stiffness_n_per_m", stiffness_range_n_per_m);
    profile.max_current_a = number(reader, "max_current_a", current_range_a);
    reader.refuse_other_keys();
}

void read_stylus(TomlReader reader, ArmProfile& profile) {
    const auto use = reader.choice("switch", {"pedal", "pedal-and-clutch"});
    profile.switch_use = use.value_or(0) == 0 ? SwitchUse::pedal : SwitchUse::pedal_and_clutch;
    profile.fixed_axis = reader.direction("fixed_axis").value_or(profile.fixed_axis);
    const auto counts = whole_numbers(reader, "counts_per_rev", static_cast<double>(most_counts_per_rev));
    const auto directions = whole_numbers(reader, "directions", 1.0);
    StylusEncoders stylus;
    stylus.spindle_axis = reader.direction("spindle_axis").value_or(stylus.spindle_axis);
    reader.refuse_other_keys();
    if (!counts) return;
    stylus.counts_per_rev = *counts;
    const auto signs = required(reader, "directions", directions);
    for (std::size_t i = 0; i < 3; ++i) {
        if (stylus.counts_per_rev[i] < 1)
            reader.fail("counts_per_rev", "'counts_per_rev' must be three numbers above 0");
        if (signs[i] == 0) reader.fail("directions", "'directions' must be three of 1 or -1");
        stylus.directions[i] = signs[i];
    }
    profile.stylus = stylus;
}

/// Null: there is none of that name.
const ShippedProfile* find_shipped(const std::string& name) {
    const auto found = std::ranges::find(shipped_profiles(), name, &ShippedProfile::name);
    return found != shipped_profiles().end() ? &*found : nullptr;
}

}  // namespace

ArmProfile parse_arm_profile(std::string_view toml, const std::string& name) {
    const toml::table root = parse_toml(toml, name);
    TomlReader reader(root, name, "the profile");
    ArmProfile profile;
    profile.name = required(reader, "name", reader.text("name"));
    if (auto measured = reader.table("measured")) profile.measured = read_measured(*std::move(measured));
    if (auto usb = reader.table("usb")) profile.usb = read_usb(*std::move(usb));
    read_arm(required(reader, "arm", reader.table("arm")), profile);
    std::vector<TomlReader> joints = reader.tables("joints");
    if (joints.size() != profile.joints.size())
        reader.fail("joints",
                    fmt::format("there are {} [[joints]]; an arm has three: a, b and c", joints.size()));
    for (std::size_t i = 0; i < joints.size(); ++i) profile.joints[i] = read_joint(joints[i]);
    read_calibration(required(reader, "calibration", reader.table("calibration")), profile);
    read_limits(required(reader, "limits", reader.table("limits")), profile);
    if (auto stylus = reader.table("stylus")) read_stylus(*std::move(stylus), profile);
    reader.refuse_other_keys();
    return profile;
}

std::vector<std::string> shipped_profile_names() {
    std::vector<std::string> names;
    for (const ShippedProfile& shipped : shipped_profiles()) names.emplace_back(shipped.name);
    return names;
}

std::string arm_profile_text(const std::string& name_or_file) {
    if (const ShippedProfile* const shipped = find_shipped(name_or_file)) return std::string(shipped->toml);
    if (std::filesystem::path(name_or_file).extension() != ".toml") {
        const auto meant = nearest_name(name_or_file, shipped_profile_names());
        throw std::runtime_error(fmt::format(
            "there is no profile '{}'; {}choose one of {}, or name a .toml file", name_or_file,
            meant ? fmt::format("did you mean {}? ", *meant) : "", fmt::join(shipped_profile_names(), ", ")));
    }
    return read_toml_text(name_or_file, "a device profile");
}

ArmProfile load_arm_profile(const std::string& name_or_file) {
    return parse_arm_profile(
        arm_profile_text(name_or_file),
        find_shipped(name_or_file) ? fmt::format("devices/{}.toml", name_or_file) : name_or_file);
}

}  // namespace osteomill
