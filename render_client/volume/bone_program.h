// A shader program that samples the bone: a renderer's own shaders behind bone_sampling_glsl, with the bone's
// textures and uniforms bound.
#pragma once

#include <optional>
#include <string>

#include "render_client/volume/bone_textures.h"
#include "render_client/volume/gl/program.h"

namespace osteomill {

class BoneProgram {
  public:
    /// Texture units from this one on are the renderer's own.
    static constexpr int first_free_unit = 8;

    /// `fragment_source` is GLSL 3.30 without its #version line. Throws std::runtime_error with the
    /// compiler's log if it does not compile for a dense bone.
    BoneProgram(const std::string& vertex_source, const std::string& fragment_source);

    /// glUseProgram, of a program for this bone's layout, with its textures on units 0 to first_free_unit
    /// - 1. The program that comes back is for the renderer's own uniforms: set them all after every call, it
    /// may be another one next time.
    const gl::Program& use(const BoneTextures& bone);

  private:
    gl::Program make(BoneLayout layout) const;

    std::string vertex_source_;
    std::string fragment_source_;
    std::optional<gl::Program> dense_;  ///< made when a bone first needs them
    std::optional<gl::Program> atlas_;
};

}  // namespace osteomill
