#include "render_client/volume/bone_program.h"

#include "render_client/volume/bone_sampling_shader.h"

namespace osteomill {

namespace {

enum TextureUnit { fraction_unit, blocks_unit, table_unit, code_unit, colours_unit };

}  // namespace

BoneProgram::BoneProgram(const std::string& vertex_source, const std::string& fragment_source)
    : vertex_source_(vertex_source), fragment_source_(fragment_source), dense_(make(BoneLayout::dense)) {}

gl::Program BoneProgram::make(BoneLayout layout) const {
    const char* places = layout == BoneLayout::dense ? dense_places_glsl : atlas_places_glsl;
    gl::Program program(vertex_source_,
                        std::string("#version 330 core\n") + places + bone_sampling_glsl + fragment_source_);
    program.use();
    program.set("bone_fraction", fraction_unit);
    program.set("bone_blocks", blocks_unit);
    program.set("bone_tile_table", table_unit);
    program.set("bone_colour_code", code_unit);
    program.set("bone_colours", colours_unit);
    return program;
}

const gl::Program& BoneProgram::use(const BoneTextures& bone) {
    const BoneLayout layout = bone.plan().layout;
    std::optional<gl::Program>& program = layout == BoneLayout::dense ? dense_ : atlas_;
    if (!program) program.emplace(make(layout));
    program->use();
    program->set("bone_size", glm::vec3(bone.box().size));
    program->set("bone_texture_size", glm::vec3(bone.fraction().size()));
    program->set("bone_has_colour_code", bone.colour_code() ? 1 : 0);
    bone.fraction().bind(fraction_unit);
    bone.blocks().bind(blocks_unit);
    bone.colours().bind(colours_unit);
    if (bone.tile_table()) bone.tile_table()->bind(table_unit);
    // An integer sampler that nothing is fetched from still needs a texture of its kind, or of none.
    if (bone.colour_code())
        bone.colour_code()->bind(code_unit);
    else
        gl::Texture3D::unbind(code_unit);
    return *program;
}

}  // namespace osteomill
