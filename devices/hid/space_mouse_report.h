// The reports of a 3Dconnexion SpaceMouse: the first byte is the report's number.
//
//   1   three int16 of translation; some models add the three of rotation
//   2   three int16 of rotation
//   3   buttons, one bit each
//
// Full deflection is about +-350. The puck's axes: x to the right, y toward the person, z down.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "devices/hid/hid_transport.h"

namespace osteomill {

/// Shares of full deflection, -1 to 1, in device space: x to the right, y away from the person, z up.
struct SpaceMouseState {
    glm::dvec3 translation{0.0};
    glm::dvec3 rotation{0.0};  ///< about those axes
    std::uint32_t buttons = 0;

    /// Applies a report; false for a meaningless one, which changes nothing. Real-time safe.
    bool take(std::span<const std::uint8_t> report) noexcept;
};

/// By vendor: Logitech's number with a product from 0xC603 to 0xC6FF, or 3Dconnexion's own; and by usage: a
/// multi-axis controller.
bool is_space_mouse(const HidDeviceInfo& device);

}  // namespace osteomill
