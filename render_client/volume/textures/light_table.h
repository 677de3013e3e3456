// Table of the light on a white surface of any direction, from the lights of lighting.h, to shade thousands
// of voxels on the CPU between two frames. Directions are in an octahedral map (Cigolle et al., "A survey of
// efficient representations for independent unit vectors", 2014), so near each other that a byte of the
// picture is off by seven at most, by less than one in the mean.
#pragma once

#include <glm/ext/vector_uint4_sized.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace osteomill {

class LightTable {
  public:
    LightTable();

    /// Display RGB of an open white surface; it exceeds 1 if a white surface is overexposed. `outward` need
    /// not be unit but must not be zero. Since the display's curve is a power, that of a colour is the
    /// product of this and display(colour).
    glm::vec3 towards(const glm::ivec3& outward) const;

  private:
    static constexpr int edge = 128;
    std::vector<glm::u8vec4> lights_;  ///< bytes, so that they stay in the cache; four, to be aligned
};

}  // namespace osteomill
