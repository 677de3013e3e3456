// Antialiased silhouettes of the bone: where depth leaps between two pixels, each is mixed from the colours
// on either side, by how much of it the nearer surface covers.
//
// What covers how much is found by one ray a pixel that looks for the fullest place near the surface's
// outline (silhouettes.frag.glsl): the picture's own rays are not drawn again, and nothing is shaded twice.
// Other pixels, and depth, stay as they were drawn. Between colours as they are displayed, as pictures are
// scaled.
#pragma once

#include <optional>

#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/passes/bone_renderer.h"
#include "render_client/volume/shaders/bone_program.h"

namespace osteomill {

struct RaycastSettings;

class Silhouettes {
  public:
    Silhouettes() : program_(silhouette_files) {}

    /// A picture to draw the bone into beforehand, bound, its viewport of that size; it may be larger.
    const gl::Framebuffer& begin(const glm::ivec2& size_px);
    /// Fills a box of the framebuffer `target` with what begin()'s picture shows there, silhouettes smoothed.
    /// What lies a pixel round the box must be drawn in there, too. Leaves the target bound.
    void draw(const BoneTextures& bone, const Camera& camera, const SceneAppearance& look,
              const RaycastSettings& settings, const glm::ivec2& size_px, GLuint target, const PixelBox& box);

  private:
    BoneProgram program_;
    std::optional<gl::Framebuffer> drawn_;
};

}  // namespace osteomill
