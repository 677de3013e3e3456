// The shadow of the burr on the bone: a cue of the burr's distance, which a single picture in perspective
// does not show otherwise.
//
// Two parts, both computed from the depth of the bone that is already drawn, for a sphere (the burr) and a
// capsule (the shank). The soft shadow under the key light leaves the burr as the burr leaves the bone, and
// widens with the distance. The contact shadow, (r / d)^2 of a sphere of radius r at distance d, is dark only
// where the burr is close; it is the part of the sky that the sphere covers.
#pragma once

#include <glm/vec3.hpp>

#include "render_client/volume/camera.h"
#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/gl/program.h"
#include "render_client/volume/passes/tile_mask.h"

namespace osteomill {

class ContactShadow {
  public:
    ContactShadow();
    /// Darkens the bound framebuffer, whose size is the mask's, and marks the tiles that it may have
    /// darkened. `bone` holds the bone's depth, as Camera::projection has it, and is not the bound
    /// framebuffer. The burr is a sphere of `radius_mm` round `burr_mm`, its shank follows `spindle_axis`
    /// (unit); patient LPS.
    void draw(const gl::Framebuffer& bone, const glm::dvec3& burr_mm, double radius_mm,
              const glm::dvec3& spindle_axis, const Camera& camera, TileMask& covered) const;

  private:
    gl::Program program_;
};

}  // namespace osteomill
