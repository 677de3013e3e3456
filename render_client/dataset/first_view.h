// The first view of a session: tool and target with their surroundings, seen from the tool's side.
//
//   what it holds      without a tool   all of the bone
//                      without a plan   the tool, and a part of the bone that shows where in it one is
//                      else             tool and target, three times as much about them
//   where it is from   the front and above, turned towards the handpiece as far as needed to look at the side
//                      of the bone that the burr is on, and on until no bone hides the burr
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "common/bone/bone.h"
#include "common/scene/scene.h"
#include "common/session/tool_state.h"
#include "common/wire/session_info.h"
#include "render_client/volume/camera.h"
#include "render_client/volume/textures/bone_textures.h"

namespace osteomill {

/// Patient LPS.
struct BallInView {
    glm::dvec3 centre_mm{0.0};
    double radius_mm = 0.0;
};

/// The smallest ball round both.
BallInView round_both(const BallInView& a, const BallInView& b);

/// Round the region of the session's plan; nothing without a plan, or without a voxel of its tissue.
std::optional<BallInView> target_in_view(const Bone& bone, const SessionInfo& session);

/// `all`: round the bone. `tool`: the burr's pose; a burr far away counts as on the edge of `all`.
Camera first_view(const Bone& bone, const BallInView& all, const std::optional<ToolPose>& tool,
                  double burr_radius_mm, const std::optional<BallInView>& target);

/// The same for a session as it is now, with the bone that the textures hold. `session` and `tool` may be
/// null.
Camera first_view(const Bone& bone, const BoneTextures& textures, const SessionInfo* session,
                  const ToolState* tool);

/// Round the bone that the textures hold.
BallInView ball_round(const BoneTextures& textures);

}  // namespace osteomill
