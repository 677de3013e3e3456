#include "devices/haply/haply_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "common/text/append.h"
#include "common/text/foreign_json.h"

namespace osteomill {

namespace {

using nlohmann::json;

constexpr std::size_t longest_id = 64;
constexpr double fastest_m_per_s = 100.0;

/// The value under a key; null if there is none.
const json& at(const json& object, const char* key) {
    static const json nothing;
    if (!object.is_object()) return nothing;
    const auto found = object.find(key);
    return found == object.end() ? nothing : *found;
}

std::optional<double> number(const json& value) {
    if (!value.is_number()) return std::nullopt;
    const double result = value.get<double>();
    return std::isfinite(result) ? std::optional(result) : std::nullopt;
}

std::optional<bool> truth(const json& value) {
    return value.is_boolean() ? std::optional(value.get<bool>()) : std::nullopt;
}

std::optional<glm::dvec3> vector(const json& value, double most) {
    const auto x = number(at(value, "x")), y = number(at(value, "y")), z = number(at(value, "z"));
    if (!x || !y || !z) return std::nullopt;
    const glm::dvec3 result(*x, *y, *z);
    return std::abs(*x) <= most && std::abs(*y) <= most && std::abs(*z) <= most ? std::optional(result)
                                                                                : std::nullopt;
}

std::optional<glm::dquat> rotation(const json& value) {
    const auto w = number(at(value, "w")), x = number(at(value, "x")), y = number(at(value, "y")),
               z = number(at(value, "z"));
    if (!w || !x || !y || !z) return std::nullopt;
    const glm::dquat result(*w, *x, *y, *z);
    const double size = glm::length(result);
    return size > 0.9 && size < 1.1 ? std::optional(result / size) : std::nullopt;
}

/// A name that our messages can contain as it is.
std::optional<std::string> identity(const json& value) {
    if (!value.is_string()) return std::nullopt;
    const auto& text = value.get_ref<const std::string&>();
    const bool is_plain = std::all_of(text.begin(), text.end(), [](char letter) {
        return letter >= ' ' && letter <= '~' && letter != '"' && letter != '\\';
    });
    return is_plain && !text.empty() && text.size() <= longest_id ? std::optional(text) : std::nullopt;
}

std::optional<HaplyInverse3> arm_of(const json& device) {
    const std::optional<std::string> id = identity(at(device, "device_id"));
    const json& state = at(device, "state");
    const std::optional<glm::dvec3> position_m = vector(at(state, "cursor_position"), farthest_m);
    if (!id || !position_m) return std::nullopt;
    const json& status = at(device, "status");
    return HaplyInverse3{.device_id = *id,
                         .position_m = *position_m,
                         .velocity_m_per_s = vector(at(state, "cursor_velocity"), fastest_m_per_s),
                         .is_calibrated = truth(at(status, "calibrated")),
                         .has_power = truth(at(status, "power_supply"))};
}

std::optional<HaplyGrip> grip_of(const json& device) {
    const json& state = at(device, "state");
    const std::optional<glm::dquat> turn = rotation(at(state, "orientation"));
    if (!turn) return std::nullopt;
    const json& buttons = at(state, "buttons");
    const json& id = at(device, "device_id");
    return HaplyGrip{
        .device_id = id.is_string() ? id.get<std::string>() : "",
        .turn = *turn,
        .button_a = truth(at(buttons, "a")).value_or(false) || truth(at(state, "button")).value_or(false),
        .button_b = truth(at(buttons, "b")).value_or(false),
        .button_c = truth(at(buttons, "c")).value_or(false)};
}

bool is_connected(const json& grip) {
    return truth(at(at(grip, "status"), "connected")).value_or(true);
}

std::optional<HaplyState> state_of(const json& message, std::string_view device_id) {
    const json& arms = at(message, "inverse3");
    if (!arms.is_array()) return std::nullopt;
    HaplyState result{.arm = {}, .grip = {}, .numbers_session = at(message, "session_id").is_number()};
    for (const json& device : arms) {
        const json& id = at(device, "device_id");
        if (!device_id.empty() && (!id.is_string() || id.get_ref<const std::string&>() != device_id))
            continue;
        result.arm = arm_of(device);
        if (!result.arm) return std::nullopt;
        break;
    }
    for (const char* kind : {"wireless_verse_grip", "verse_grip"}) {
        const json& grips = at(message, kind);
        if (!grips.is_array()) continue;
        const auto found = std::find_if(grips.begin(), grips.end(), is_connected);
        if (found == grips.end()) continue;
        result.grip = grip_of(*found);
        if (!result.grip) return std::nullopt;
        break;
    }
    return result;
}

}  // namespace

std::optional<HaplyState> parse_haply_state(std::string_view text, std::string_view device_id) noexcept {
    try {
        const json message = parse_foreign_json(text, "a message");
        if (!message.is_object()) return std::nullopt;
        return state_of(message, device_id);
    } catch (const std::exception&) {  // no JSON, or too deep; memory
        return std::nullopt;
    }
}

void write_haply_force(std::string& text, std::string_view device_id, const glm::dvec3& force_n,
                       HaplyForceField field) {
    const auto plain = [](double value) { return std::isfinite(value) ? value : 0.0; };
    text.clear();
    append_formatted(text,
                     R"({{"inverse3":[{{"device_id":"{}","commands":{{"set_cursor_force":{{"{}":)"
                     R"({{"x":{:.6f},"y":{:.6f},"z":{:.6f}}}}}}}}}]}})",
                     device_id, field == HaplyForceField::vector ? "vector" : "values", plain(force_n.x),
                     plain(force_n.y), plain(force_n.z));
}

}  // namespace osteomill
