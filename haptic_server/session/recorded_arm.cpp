#include "haptic_server/session/recorded_arm.h"

#include <stdexcept>

#include "common/files/input_file.h"
#include "common/session/written_pose.h"
#include "common/text/foreign_json.h"

namespace osteomill {

nlohmann::ordered_json arm_settings(const DeviceLimits& arm) {
    return {{"max_force_n", arm.max_force_n},
            {"max_stiffness_n_per_mm", arm.max_stiffness_n_per_mm},
            {"apparent_mass_kg", arm.apparent_mass_kg},
            {"position_resolution_mm", arm.position_resolution_mm},
            {"damping_n_s_per_mm", arm.damping_n_s_per_mm},
            {"gives_force", arm.gives_force}};
}

DeviceLimits arm_of_settings(const std::string& text, const std::string& name) {
    DeviceLimits arm;
    try {
        const auto json = parse_foreign_json(text, name);
        arm = {.max_force_n = json.at("max_force_n"),
               .max_stiffness_n_per_mm = json.at("max_stiffness_n_per_mm"),
               .apparent_mass_kg = json.at("apparent_mass_kg"),
               .position_resolution_mm = json.at("position_resolution_mm"),
               .damping_n_s_per_mm = json.at("damping_n_s_per_mm"),
               .gives_force = json.at("gives_force")};
    } catch (const nlohmann::json::exception&) {
        throw std::runtime_error(name +
                                 ": does not say what the arm can do, as a recording's setting 'arm' does");
    }
    const bool is_arm = arm.max_force_n > 0.0 && arm.max_stiffness_n_per_mm > 0.0 &&
                        arm.apparent_mass_kg > 0.0 && arm.position_resolution_mm >= 0.0 &&
                        arm.damping_n_s_per_mm >= 0.0;
    if (!is_arm)
        throw std::runtime_error(
            name +
            ": the arm's force, stiffness and mass must be above 0, its resolution and damping 0 or more");
    return arm;
}

std::optional<DeviceLimits> arm_of_trajectory(const std::filesystem::path& file) {
    const std::string text = read_text(file, trajectory_kind);
    if (!text.starts_with(trajectory_arm)) return std::nullopt;
    const std::size_t begin = trajectory_arm.size();
    return arm_of_settings(text.substr(begin, text.find_first_of("\r\n") - begin), file.string() + ":1");
}

}  // namespace osteomill
