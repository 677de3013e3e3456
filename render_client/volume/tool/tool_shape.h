// Shapes beside the bone, as triangles: burr with shank, force arrow, sphere.
#pragma once

#include "common/scene/burr_head.h"
#include "render_client/volume/tool/triangles.h"

namespace osteomill {

struct BurrShape {
    double diameter_mm = 5.0;
    BurrHead head{};
    int edges = 6;
    bool clockwise = true;  ///< which way the flutes wind

    bool operator==(const BurrShape&) const = default;
};

/// Fluted head in the burr frame: +z from tip to shank, mm. The flutes are cut into the head, so the outline
/// is the burr's true one.
Triangles burr_head(const BurrShape& burr);

/// Tapered neck and cylindrical shank in the same frame. Its lower end is open, within the head.
Triangles burr_shank(const BurrShape& burr);

/// An arrow from the origin along +z of length 1 with a shaft and a head.
Triangles unit_arrow(const glm::vec3& linear_rgb);

/// A sphere of radius 1 round the origin.
Triangles unit_sphere(const glm::vec3& linear_rgb);

}  // namespace osteomill
