// Ray casting: every pixel's ray goes front to back, leaps over empty blocks, and ends where the trilinear
// fraction reaches one half or, in translucent bone, where hardly any light comes through.
#pragma once

#include <optional>
#include <span>

#include "render_client/volume/passes/bone_renderer.h"
#include "render_client/volume/passes/silhouettes.h"
#include "render_client/volume/shaders/bone_program.h"

namespace osteomill {

/// `none` visits every sample from where a ray enters the bone's box; it exists to show that `distance_map`
/// changes no pixel.
enum class EmptySpaceSkipping { distance_map, none };

struct RaycastSettings {
    EmptySpaceSkipping skipping = EmptySpaceSkipping::distance_map;
    /// Distance of the samples along a ray, voxels, above 0. A chord through bone shorter than this may be
    /// missed. Most of a frame's time goes into shading: 1.0 saves a tenth of it, and 3 to 5 dB.
    float step_voxels = 0.5f;
};

/// Window depth = x + y / distance along the camera's axis, in voxels of `spacing_mm`.
glm::vec2 depth_terms(const Camera& camera, double spacing_mm, const glm::ivec2& size_px);

/// Sets the uniforms of camera_rays.vert.glsl and bone_rays.glsl in a program that BoneProgram::use has made
/// ready.
void set_ray_uniforms(const gl::Program& program, const BoneTextures& bone, const Camera& camera,
                      const glm::ivec2& size_px, const RaycastSettings& settings);

class RaycastRenderer final : public BoneRenderer {
  public:
    explicit RaycastRenderer(const RaycastSettings& settings = {});
    void draw(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px) override;
    void draw_parts(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px,
                    std::span<const PixelBox> parts) override;

  private:
    bool smooths(const BoneTextures& bone) const;
    void draw_smooth(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px,
                     std::span<const PixelBox> parts);
    void draw_rays(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px);

    Background background_;
    BoneProgram bone_program_;
    RaycastSettings settings_;
    std::optional<Silhouettes> silhouettes_;  ///< once they are to be smooth
};

}  // namespace osteomill
