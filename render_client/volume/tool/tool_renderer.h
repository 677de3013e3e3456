// A renderer of everything beside the bone: the burr with its shank, the handpiece, the force on the hand as
// an arrow, the hand's target as a ghost. All are meshes, tested against the bone's depth. The part of the
// shank that would hide the burr or its surroundings is translucent, and a handpiece that points at the eye
// is not there.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "common/session/tool_state.h"
#include "render_client/volume/camera.h"
#include "render_client/volume/gl/mesh.h"
#include "render_client/volume/gl/program.h"
#include "render_client/volume/passes/tile_mask.h"
#include "render_client/volume/tool/tool_shape.h"

namespace osteomill {

/// Objects beside the bone in one frame; patient LPS.
struct DrawnTool {
    ToolState state;
    BurrShape burr{};  ///< of that state
    double spin_rad = 0.0;
    BurrMotion motion = BurrMotion::still;
    bool has_handpiece = false;
    std::optional<glm::dvec3> hand_target_mm{};  ///< drawn as a translucent burr where it is given
    bool is_only_a_thing = false;                ///< no part of it is seen through, no force is drawn
};

/// Pose of the tool's own axes (the shapes of tool_shape.h) in patient LPS, mm.
glm::dmat4 pose_of(const DrawnTool& tool);

/// Opacity of the handpiece, 0 to 1: it is solid seen from the side, and fades as its axis turns to the eye,
/// from 60 to 30 degrees, for it would hide the whole field. 0 for a tool without one.
double handpiece_opacity(const DrawnTool& tool, const Camera& camera);

/// Patient LPS.
struct ForceArrow {
    glm::dvec3 from_mm{0.0};
    glm::dvec3 head_mm{0.0};
};

/// The force on the hand, from the burr's surface outwards: 4 mm a newton, and at least 40 pixels long in the
/// picture, unless the arrow points at the eye or away from it. Nothing below 0.02 N, or if the burr is not
/// before the eye.
std::optional<ForceArrow> force_arrow(const ToolState& tool, double burr_radius_mm, const Camera& camera,
                                      const glm::ivec2& size_px);

class ToolRenderer {
  public:
    ToolRenderer();
    /// Draws over the bound framebuffer, whose depth is that of Camera::projection and whose size that of the
    /// mask; marks the tiles that it may have drawn into.
    void draw(const DrawnTool& tool, const Camera& camera, TileMask& covered);
    /// Draws what is seen through, a part of the shank and a handpiece that fades, over all that is behind
    /// it. Call after draw(), with the same tool and camera.
    void draw_seen_through(const DrawnTool& tool, const Camera& camera, const glm::ivec2& size_px) const;

    /// Draws the force, outlined, over everything drawn before: it is information, not a thing.
    void draw_force(const DrawnTool& tool, const Camera& camera, TileMask& covered) const;

  private:
    struct Finish {
        float opacity = 1.0f;
        float polish = 0.0f;     ///< 0 matt, 1 steel
        float sees_through = 0;  ///< as in tool.frag.glsl
    };
    /// The program must be in use.
    void draw_mesh(const gl::Mesh& mesh, const glm::dmat4& model, const glm::dmat4& view_projection,
                   const Finish& finish, TileMask& covered) const;
    void place_mesh(const glm::dmat4& model, const glm::dmat4& view_projection, const Finish& finish) const;
    void shape(const DrawnTool& tool);

    gl::Program program_;
    gl::Mesh arrow_;
    gl::Mesh arrow_outline_;
    gl::Mesh ghost_;
    BurrShape burr_shape_;
    BurrMotion burr_motion_ = BurrMotion::still;
    gl::Mesh head_;
    gl::Mesh shank_;
    gl::Mesh handpiece_;
};

}  // namespace osteomill
