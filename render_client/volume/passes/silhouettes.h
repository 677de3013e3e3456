// Antialiased silhouettes of the bone: where depth jumps between two pixels, each is a mixture of the colours
// on either side, by the share of it that the nearer surface covers.
//
// One ray for each such pixel finds the share: it looks for the fullest place near the surface's outline
// (silhouettes.frag.glsl). The picture's own rays are not drawn again, and nothing is shaded twice. Other
// pixels, and depth, stay as they were drawn. Display colours are mixed, as in the scaling of pictures. Only
// blocks of 8 x 8 pixels with a depth discontinuity are searched (discontinuity_blocks.frag.glsl).
#pragma once

#include <optional>
#include <span>

#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/passes/bone_renderer.h"
#include "render_client/volume/shaders/bone_program.h"
#include "render_client/volume/shaders/shader_files.h"

namespace osteomill {

struct RaycastSettings;

/// Part of a picture, and the part of that in which bone may be seen: only there are silhouettes.
struct SmoothedPart {
    PixelBox box{};
    PixelBox near_bone{};
};

class Silhouettes {
  public:
    Silhouettes() : program_(silhouette_files), block_program_(make_program(discontinuity_block_files)) {}

    /// A picture to draw the bone into beforehand, bound, its viewport of that size; it may be larger.
    const gl::Framebuffer& begin(const glm::ivec2& size_px);
    /// Fills parts of the framebuffer `target` with what begin()'s picture shows there, silhouettes smoothed.
    /// A border of one pixel round each part must be drawn there, too. The scissor test is on. Leaves the
    /// target bound, and the scissor somewhere within the last part.
    void draw(const BoneTextures& bone, const Camera& camera, const SceneAppearance& look,
              const RaycastSettings& settings, const glm::ivec2& size_px, GLuint target,
              std::span<const SmoothedPart> parts);

  private:
    void find_discontinuities(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px,
                              std::span<const SmoothedPart> parts);
    void search(const BoneTextures& bone, const Camera& camera, const SceneAppearance& look,
                const RaycastSettings& settings, const glm::ivec2& size_px,
                std::span<const SmoothedPart> parts);

    BoneProgram program_;
    gl::Program block_program_;
    std::optional<gl::Framebuffer> drawn_;
    std::optional<gl::Framebuffer> blocks_;  ///< a pixel each: whether depth is discontinuous there
};

}  // namespace osteomill
