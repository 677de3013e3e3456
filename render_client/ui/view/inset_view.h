// A second view, small: down beside the handpiece onto the burr, or an axial section of the bone through it.
#pragma once

#include <memory>
#include <span>

#include "render_client/volume/passes/bone_renderer.h"
#include "render_client/volume/passes/scene_picture.h"

namespace osteomill {

enum class InsetKind { off, endoscope, axial };

/// From 10 mm up the handpiece and 4 mm beside it, in front, towards the burr.
Camera endoscope_camera(const glm::dvec3& burr_mm, const glm::dvec3& spindle_axis);
/// Width of the axial view.
inline constexpr double axial_width_mm = 20.0;
/// From above, where the light is, the patient's front up. Shown mirrored, it is the section as radiologists
/// look at it, from the feet.
Camera axial_camera(const glm::dvec3& burr_mm);
/// Takes away all above the burr's centre.
CutPlane axial_cut(const glm::dvec3& burr_mm);

class InsetView {
  public:
    explicit InsetView(RendererChoice renderer);

    // These do the same as ScenePicture's.
    void forget_bone(DrawingCost cost) { picture_.forget_bone(cost); }
    void mark_dirty(const BoneTextures& bone, std::span<const VoxelBox> changed) {
        picture_.mark_dirty(bone, changed);
    }
    /// `look` is that of the large view. `kind` must not be off.
    const gl::Framebuffer& draw(InsetKind kind, const BoneTextures& bone, const DrawnTool& tool,
                                SceneAppearance look, int edge_px);

  private:
    std::unique_ptr<BoneRenderer> renderer_;
    ScenePicture picture_;
};

}  // namespace osteomill
