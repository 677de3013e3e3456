// Clutch: the hand moves while the tool stays, like lifting a mouse. While engaged the position does not
// follow; afterwards it continues from its last value.
#pragma once

#include <glm/vec3.hpp>

namespace osteomill {

class Clutch {
  public:
    /// The tool's position for this position of the hand, both mm. Real-time safe.
    glm::dvec3 position_mm(const glm::dvec3& hand_mm, bool is_engaged) noexcept {
        if (is_engaged) offset_mm_ = tool_mm_ - hand_mm;
        tool_mm_ = hand_mm + offset_mm_;
        return tool_mm_;
    }

  private:
    glm::dvec3 offset_mm_{0.0};
    glm::dvec3 tool_mm_{0.0};
};

}  // namespace osteomill
