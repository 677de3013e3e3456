// Shapes beside the bone, as triangles: burr with shank and handpiece, force arrow, sphere.
#pragma once

#include "common/scene/burr.h"
#include "render_client/volume/tool/triangles.h"

namespace osteomill {

struct BurrShape {
    double diameter_mm = 5.0;
    BurrHead head{};
    int edges = 6;
    bool clockwise = true;  ///< which way the flutes wind
    ShankProfile shank{};   ///< empty: the usual one for such a head

    bool operator==(const BurrShape&) const = default;
};

/// At speed, a burr turns many times while the eye, or a camera, takes one picture: flutes and marks are
/// blurred about the axis. A fifth of their contrast is left, so that it is seen which way the burr turns.
enum class BurrMotion { still, at_speed };

/// Fluted head in the burr frame: +z from tip to shank, mm. The flutes are cut into the head, so the outline
/// is the burr's true one. At speed it is the body of revolution that the flutes sweep.
Triangles burr_head(const BurrShape& burr, BurrMotion motion = BurrMotion::still);

/// Neck and shank in the same frame: the burr's profile up to where it widens to a handpiece, or a tapered
/// neck and a cylinder. Its lower end is open, within the head.
Triangles burr_shank(const BurrShape& burr, BurrMotion motion = BurrMotion::still);

/// A straight surgical handpiece from the end of the shank on, in the same frame: nose, ribbed grip, body,
/// cable; 9 mm about the axis at most. It does not turn with the burr.
Triangles handpiece(const BurrShape& burr);

/// An arrow from the origin along +z of length 1 with a shaft and a head.
Triangles unit_arrow(const glm::vec3& linear_rgb);

/// A sphere of radius 1 round the origin.
Triangles unit_sphere(const glm::vec3& linear_rgb);

}  // namespace osteomill
