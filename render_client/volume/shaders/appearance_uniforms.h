// Uniforms of a SceneAppearance, for background.glsl, cuts.glsl, grain.glsl and sawn_faces.glsl.
#pragma once

#include "render_client/volume/camera.h"
#include "render_client/volume/gl/program.h"
#include "render_client/volume/scene_appearance.h"
#include "render_client/volume/textures/bone_textures.h"

namespace osteomill {

/// Number of an appearance's cuts that a renderer draws. It is fixed when a program is compiled: most
/// pictures have no cut, and then no pixel pays for one.
int cut_count(const SceneAppearance& look);

/// The program must be in use.
void set_background_uniforms(const gl::Program& program, const SceneAppearance& look);
void set_cut_uniforms(const gl::Program& program, const SceneAppearance& look, const BoneTextures& bone);
void set_sawn_uniforms(const gl::Program& program, const BoneTextures& bone);
/// `size_px` is that of the picture: grain that its pixels do not resolve, at the distance that the camera
/// turns about, fades away.
void set_grain_uniforms(const gl::Program& program, const BoneTextures& bone, const Camera& camera,
                        const glm::ivec2& size_px);

}  // namespace osteomill
