// Messages between Haply's local service and a program: JSON in WebSocket messages (docs.haply.co,
// Inverse SDK, "WebSocket Protocol", versions 3.1 to 3.5). The service states all devices at once when a
// program connects, and then once for each message of the program:
//
//   {"inverse3": [{"device_id": "049D", "config": {...}, "state": {"cursor_position": {"x": 0.0, ...},
//                  "cursor_velocity": {...}, ...}, "status": {"calibrated": true, ...}}],
//    "wireless_verse_grip": [{"device_id": "61548", "state": {"orientation": {"w": 1.0, ...},
//                             "buttons": {"a": false, "b": false, "c": false}}}],
//    "verse_grip": [{"device_id": "...", "state": {"orientation": {...}, "button": false}}]}
//
// The program answers with a force on the cursor, for one exchange: an arm that is sent nothing more goes
// idle
// ("Control Commands"). Metres and newtons, in the service's own axes. A wired grip has one button; it counts
// as `a`.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace osteomill {

/// The arm, as stated in one message. A status that the message does not state is empty.
struct HaplyInverse3 {
    std::string device_id;
    glm::dvec3 position_m{0.0};
    std::optional<glm::dvec3> velocity_m_per_s{};
    std::optional<bool> is_calibrated{};
    std::optional<bool> has_power{};
};

/// The handle.
struct HaplyGrip {
    std::string device_id;
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};  ///< grip's frame to the service's axes
    bool button_a = false;
    bool button_b = false;
    bool button_c = false;
};

/// How the components of a force are called: the field was renamed between the versions of the service.
enum class HaplyForceField { values, vector };

struct HaplyState {
    std::optional<HaplyInverse3> arm;  ///< none: it is not there
    std::optional<HaplyGrip> grip;     ///< the first that is connected, wireless ones before wired ones
    bool numbers_session = false;      ///< only the first message of newer services does
};

/// Positions beyond it are no arm's.
inline constexpr double farthest_m = 5.0;

/// The state of the arm `device_id` in a message, or of the first arm if `device_id` is empty. Nullopt: the
/// message is no state, or its values for the arm or the grip are unusable (no numbers, no rotation). Throws
/// nothing.
std::optional<HaplyState> parse_haply_state(std::string_view text, std::string_view device_id) noexcept;

/// A force on the cursor of an arm, as `text`. A component that is not finite is zero.
void write_haply_force(std::string& text, std::string_view device_id, const glm::dvec3& force_n,
                       HaplyForceField field);

/// Asks for the state of all devices, and does nothing.
inline constexpr std::string_view haply_question = R"({"session":{"force_render_full_state":{}}})";

}  // namespace osteomill
