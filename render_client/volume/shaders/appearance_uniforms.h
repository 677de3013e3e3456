// Uniforms of a SceneAppearance, for background.glsl and cuts.glsl.
#pragma once

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

}  // namespace osteomill
