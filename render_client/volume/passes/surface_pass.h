// The surfaces of one moment as numbers: for every pixel the depth, the normal and the number of the object
// that its ray meets first.
//
// Each pixel has a ray of its own through its middle, and nothing is blended: at a silhouette a pixel belongs
// to one object, with that object's depth. Bone is found by the same steps as in RaycastRenderer, tool and
// structures are the meshes of the picture, so that picture and numbers agree. Every object is solid: a
// translucent one has its first surface.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "render_client/volume/gl/mesh.h"
#include "render_client/volume/gl/name.h"
#include "render_client/volume/passes/raycast_renderer.h"
#include "render_client/volume/structures/structure_surface.h"
#include "render_client/volume/tool/tool_renderer.h"

namespace osteomill {

/// Rows from the top, pixels from the left.
struct SurfaceImage {
    static constexpr std::uint8_t nothing = 0, burr = 1, shank = 2, bone = 3;
    static constexpr float no_depth = std::numeric_limits<float>::infinity();

    glm::ivec2 size_px{0};
    std::vector<float> depth_mm;      ///< along the camera's axis; no_depth where there is nothing
    std::vector<glm::vec3> normal;    ///< unit, out of the thing; the camera's axes right, down, forward
    std::vector<std::uint8_t> thing;  ///< one of those above, or a structure's own number
};

class SurfacePass {
  public:
    /// Throws std::runtime_error if the driver cannot draw into such a picture.
    explicit SurfacePass(const glm::ivec2& size_px);

    /// Adds a soft structure with its number in pictures, which is above those of SurfaceImage.
    void add_structure(const StructureSurface& surface, std::uint8_t thing);

    /// Marks voxels of the bone's grid() that changed since the last draw, as its update returned them.
    void mark_dirty(std::span<const VoxelBox> changed) {
        dirty_.insert(dirty_.end(), changed.begin(), changed.end());
    }

    /// The bone must always be the same. While the camera stays, only parts that may have changed are drawn.
    /// `tool` null: there is none yet. Surfaces before the camera's near plane or behind its far plane are
    /// not seen.
    SurfaceImage draw(const BoneTextures& bone, const DrawnTool* tool, const Camera& camera);

  private:
    struct Structure {
        gl::Mesh mesh;
        glm::dvec3 origin_mm;
        std::uint8_t thing;
    };
    void draw_bone(const BoneTextures& bone, const Camera& camera);
    void draw_meshes(const DrawnTool* tool, const Camera& camera);
    SurfaceImage read_back() const;

    glm::ivec2 size_px_;
    gl::FramebufferName framebuffer_;
    gl::RenderbufferName surface_;
    gl::RenderbufferName thing_;
    gl::RenderbufferName depth_;
    BoneProgram bone_program_;
    gl::Program mesh_program_;
    BurrShape burr_shape_;
    gl::Mesh head_;
    gl::Mesh shank_;
    std::vector<Structure> structures_;
    std::optional<Camera> camera_;  ///< of what is drawn
    std::vector<VoxelBox> dirty_;   ///< since
    TileMask covered_;              ///< by the tool
};

}  // namespace osteomill
