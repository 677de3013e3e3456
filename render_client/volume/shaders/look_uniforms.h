// Uniforms of a SceneLook, for background.glsl and cuts.glsl.
#pragma once

#include "render_client/volume/gl/program.h"
#include "render_client/volume/scene_look.h"
#include "render_client/volume/textures/bone_textures.h"

namespace osteomill {

/// How many cuts a look has, of those that a renderer heeds. Fixed when a program is compiled: in most
/// pictures there is none, and what no picture needs is to cost no pixel anything.
int cut_count(const SceneLook& look);

/// The program must be in use.
void set_background_uniforms(const gl::Program& program, const SceneLook& look);
void set_cut_uniforms(const gl::Program& program, const SceneLook& look, const BoneTextures& bone);

}  // namespace osteomill
