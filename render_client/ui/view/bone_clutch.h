// The clutch with which the bone is moved and turned under the tool: while it is held the tool keeps its
// place in the picture, and the camera, with the tool, goes round and past the bone.
//
// To the bone's own coordinates the tool moves as the camera does:
//
//     p = eye + C C0^T (p0 - eye0),   axis = C C0^T axis0
//
// with C the camera's axes (right, up, back) in patient LPS, 0 for where it was taken hold of. A camera that
// has not moved gives the very pose back.
#pragma once

#include <optional>

#include "common/scene/scene.h"
#include "render_client/volume/camera.h"

namespace osteomill {

class BoneClutch {
  public:
    /// `tool`: where the burr is now, patient LPS.
    void hold(const Camera& camera, const ToolPose& tool) { held_ = Held{camera, tool}; }
    void let_go() { held_.reset(); }
    bool is_held() const { return held_.has_value(); }

    bool has_moved(const Camera& camera) const { return !(camera == held_->camera); }
    /// The tool's pose relative to the bone, seen through `camera`. Only while it is held.
    ToolPose pose(const Camera& camera) const;

  private:
    struct Held {
        Camera camera;
        ToolPose tool;
    };
    std::optional<Held> held_;
};

}  // namespace osteomill
