#include "devices/measured/measured_profile.h"

#include <fmt/format.h>

#include "common/scene/scene_file.h"
#include "common/scene/toml_text.h"

namespace osteomill {

namespace {

constexpr double per_m = 1000.0;

}  // namespace

MeasuredArm read_measured(TomlReader reader) {
    MeasuredArm arm;
    arm.calm_n_per_mm =
        required(reader, "calm_n_per_m", reader.number("calm_n_per_m", {10.0, 20'000.0})) / per_m;
    arm.damping_n_s_per_mm =
        required(reader, "damping_n_s_per_m", reader.number("damping_n_s_per_m", {0.1, 100.0})) / per_m;
    arm.step_mm = required(reader, "step_mm", reader.number("step_mm", {0.0, 10.0}));
    arm.noise_mm = required(reader, "noise_mm", reader.number("noise_mm", {0.0, 10.0}));
    if (const auto delay_ms = reader.number("delay_ms", {0.0, 100.0})) arm.delay_s = *delay_ms / per_m;
    arm.moving_mass_kg = reader.number("moving_mass_kg", {0.005, 5.0});
    arm.friction_n = reader.number("friction_n", {0.0, 40.0});
    reader.refuse_other_keys();
    return arm;
}

MeasuredProfile load_measured_profile(const std::filesystem::path& file) {
    const std::string name = file.string();
    const toml::table root = parse_toml(read_toml_text(name, "a measured profile"), name);
    TomlReader reader(root, name, "the profile");
    MeasuredProfile profile;
    profile.arm = required(reader, "name", reader.text("name"));
    profile.measured = read_measured(required(reader, "measured", reader.table("measured")));
    reader.refuse_other_keys();
    return profile;
}

std::string measured_table(const MeasuredArm& measured) {
    std::string text = "# By haptic_server --measure-arm: docs/hardware.md explains the keys.\n[measured]\n";
    const auto add = [&text](const char* key, double value, int decimals) {
        text += fmt::format("{} = {:.{}f}\n", key, value, decimals);
    };
    add("calm_n_per_m", per_m * measured.calm_n_per_mm, 0);
    add("damping_n_s_per_m", per_m * measured.damping_n_s_per_mm, 1);
    add("step_mm", measured.step_mm, 4);
    add("noise_mm", measured.noise_mm, 4);
    if (measured.delay_s) add("delay_ms", per_m * *measured.delay_s, 1);
    if (measured.moving_mass_kg) add("moving_mass_kg", *measured.moving_mass_kg, 3);
    if (measured.friction_n) add("friction_n", *measured.friction_n, 3);
    return text;
}

std::string measured_profile_text(const MeasuredProfile& profile) {
    return fmt::format("name = {}\n\n{}", toml_quoted(profile.arm), measured_table(profile.measured));
}

std::string with_measured_table(std::string_view profile_text, const MeasuredArm& measured) {
    std::string kept;
    bool is_in_old = false;
    while (!profile_text.empty()) {
        const std::size_t end = profile_text.find('\n');
        const std::string_view line = profile_text.substr(0, end);
        profile_text.remove_prefix(end == std::string_view::npos ? profile_text.size() : end + 1);
        const std::size_t first = line.find_first_not_of(" \t");
        const bool begins_table = first != std::string_view::npos && line[first] == '[';
        if (begins_table) is_in_old = line.substr(first).starts_with("[measured]");
        if (line.starts_with("# By haptic_server --measure-arm")) continue;
        if (!is_in_old) kept.append(line).append("\n");
    }
    while (kept.ends_with("\n\n")) kept.pop_back();
    return kept + "\n" + measured_table(measured);
}

}  // namespace osteomill
