// Viewpoint on the bone: the eye's place, the picture's orientation and its width.
//
// On the wire it is the message of the same name: from a window to a server that records it, and in that
// recording.
#pragma once

#include <glm/ext/quaternion_double.hpp>
#include <glm/vec3.hpp>

namespace osteomill {

struct Viewpoint {
    glm::dvec3 eye_mm{0.0};  ///< patient LPS; of a pair of eyes the middle
    /// Rotation of the picture's axes (right, down, forward) in patient LPS; unit.
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    double field_of_view_rad = 0.6;  ///< from the picture's top to its bottom

    bool operator==(const Viewpoint&) const = default;
};

}  // namespace osteomill
