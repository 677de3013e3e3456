// View-aligned slices through the 3D texture, as the published system drew: polygons parallel to the picture,
// front to back. A pixel of a slice in bone is shaded and hides what is behind it by its depth, which the
// rasteriser tests before the next slice is sampled; translucent bone is blended.
//
// A slice stands for half a step before it and half a step behind, so a depth is off by half the spacing at
// most. The surface in its pixels is found by bisecting the step before it, so that slices leave no rings.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/gl/mesh.h"
#include "render_client/volume/passes/bone_renderer.h"
#include "render_client/volume/shaders/bone_program.h"

namespace osteomill {

struct SliceSettings {
    /// Distance of the slices, voxels, above 0.
    float spacing_voxels = 0.75f;
};

class SliceRenderer final : public BoneRenderer {
  public:
    explicit SliceRenderer(const SliceSettings& settings = {});
    void draw(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px) override;

  private:
    enum class Pass { solid, light, depth };

    void draw_slices(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px, Pass pass);
    void draw_translucent(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px);

    SliceSettings settings_;
    BoneProgram slice_program_;
    Background background_;
    gl::Program blend_program_;
    gl::TriangleStream slices_;
    std::optional<gl::LightLayer> light_;  ///< of the size that was last drawn translucent
};

// Slices through a box, parallel to the picture: the proxy geometry of volume rendering by 3D textures
// (Cabral, Cam, Foran 1994).

/// Triangles, three corners each, of the planes that cut the box `low` to `high` at whole multiples of
/// `spacing` along `forward` (unit) from the eye, as far as they are in front of it; front to back. All
/// lengths are in the same unit. Throws std::invalid_argument unless the spacing is positive.
std::vector<glm::vec3> view_slices(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& eye,
                                   const glm::dvec3& forward, double spacing);

}  // namespace osteomill
