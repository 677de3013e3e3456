// A shader program that samples the bone: a renderer's own shaders behind bone_sampling.glsl and cuts.glsl,
// with the bone's textures and the uniforms of both bound.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "render_client/volume/gl/program.h"
#include "render_client/volume/gl/texture.h"
#include "render_client/volume/scene_appearance.h"
#include "render_client/volume/shaders/shader_files.h"
#include "render_client/volume/textures/bone_textures.h"

namespace osteomill {

// Distances within which the bone's shaders read around a point.

/// Distance from a voxel, along an axis, of the farthest surface whose shading depends on it:
/// ambient_occlusion (bone_sampling.glsl) looks 16 voxels away into a map of 4-voxel blocks whose
/// interpolation reads 2 voxels beyond each; one in reserve.
inline constexpr int shading_reach_voxels = 19;
/// Distance for position and direction of a surface, which show a carve: gradient_at reads, 2 voxels away,
/// values that are smoothed over 3; one in reserve.
inline constexpr int surface_reach_voxels = 6;

class BoneProgram {
  public:
    /// Texture units from this one on are the renderer's own.
    static constexpr int first_free_unit = 10;

    explicit BoneProgram(const ProgramFiles& own) : own_(own) {}

    /// glUseProgram of a program for this bone's layout and appearance, with its textures on units 0 to
    /// first_free_unit - 1. Set all the renderer's own uniforms of the returned program after every call,
    /// since the next call may return another one. Throws std::runtime_error with the compiler's log if the
    /// shaders do not compile.
    const gl::Program& use(const BoneTextures& bone, const SceneAppearance& look);

  private:
    /// Choices that are fixed when a program is compiled: a software rasteriser computes both sides of a
    /// branch on a uniform for every pixel.
    struct Variant {
        BoneLayout layout = BoneLayout::dense;
        bool has_colour_code = false;
        bool codes_are_mostly_alike = false;
        bool has_smoothed = false;
        bool has_surface_colours = false;
        bool is_translucent = false;
        bool is_occluded = true;
        bool shows_through = false;
        bool shines = false;
        bool has_grain = false;
        bool has_sawn_faces = false;
        int cut_count = 0;
        bool cuts_show_ct = false;

        bool operator==(const Variant&) const = default;
    };
    gl::Program make(const Variant& variant) const;
    const gl::Program& program_for(const Variant& variant);
    static void bind_seen(const gl::Program& program, const BoneTextures& bone, const SeenThrough& seen);
    void bind_ct(const gl::Program& program, const BoneTextures& bone, const SceneAppearance& look);

    ProgramFiles own_;
    /// The appearance's CT, as grey; made when a cut first shows it.
    struct CtTexture {
        std::shared_ptr<const CtVolume> ct;
        HuWindow window;
        gl::Texture3D grey;
    };
    std::unique_ptr<CtTexture> ct_;
    std::vector<std::pair<Variant, gl::Program>> programs_;  ///< made when a bone first needs them
};

}  // namespace osteomill
