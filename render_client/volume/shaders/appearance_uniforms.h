// Uniforms of a SceneAppearance, for background.glsl and cuts.glsl.
#pragma once

#include "render_client/volume/gl/program.h"
#include "render_client/volume/scene_appearance.h"
#include "render_client/volume/textures/bone_textures.h"

namespace osteomill {

/// How many cuts a look has, of those that a renderer heeds. Fixed when a program is compiled: in most
/// pictures there is none, and what no picture needs is to cost no pixel anything.
int cut_count(const SceneAppearance& look);

/// The program must be in use.
void set_background_uniforms(const gl::Program& program, const SceneAppearance& look);
void set_cut_uniforms(const gl::Program& program, const SceneAppearance& look, const BoneTextures& bone);

}  // namespace osteomill
