// The .glsl files of this folder, which the build embeds, and the text of a shader made from some of them.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "render_client/volume/gl/program.h"
#include "render_client/volume/shaders/shader_programs.h"

namespace osteomill {

struct ShaderFile {
    std::string_view name;  ///< such as "lighting.glsl"
    std::string_view text;
};

/// All shader files.
std::span<const ShaderFile> shader_files();

/// GLSL 3.30: `constants`, then the files in this order. Empty names are skipped; std::logic_error for one
/// that no file has.
std::string shader_text(std::span<const std::string_view> names, const std::string& constants = {});

/// Compiles and links two such texts. Throws std::runtime_error with the compiler's log, in which errors name
/// file and line: "cuts.glsl:12".
gl::Program make_program(const std::string& vertex_text, const std::string& fragment_text);
gl::Program make_program(const ProgramFiles& files);

}  // namespace osteomill
