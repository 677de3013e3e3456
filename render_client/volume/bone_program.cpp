#include "render_client/volume/bone_program.h"

#include "render_client/volume/bone_sampling_shader.h"

namespace osteomill {

namespace {

enum TextureUnit { fraction_unit, mean_unit, distance_unit, code_unit, colours_unit, surface_unit };

}  // namespace

BoneProgram::BoneProgram(const std::string& vertex_source, const std::string& fragment_source)
    : program_(vertex_source, std::string("#version 330 core\n") + bone_sampling_glsl + fragment_source) {
    program_.use();
    program_.set("bone_fraction", fraction_unit);
    program_.set("bone_mean_fraction", mean_unit);
    program_.set("bone_skip_distance", distance_unit);
    program_.set("bone_colour_code", code_unit);
    program_.set("bone_colours", colours_unit);
    program_.set("bone_surface_colours", surface_unit);
}

const gl::Program& BoneProgram::use(const BoneTextures& bone) {
    program_.use();
    program_.set("bone_size", glm::vec3(bone.box().size));
    program_.set("bone_mm_per_voxel", static_cast<float>(bone.grid().spacing_mm));
    program_.set("bone_has_colour_code", bone.colour_code() ? 1 : 0);
    program_.set("bone_has_surface_colours", bone.surface_colours() != nullptr ? 1 : 0);
    program_.set("bone_is_translucent", bone.is_translucent() ? 1 : 0);
    bone.fraction().bind(fraction_unit);
    bone.mean_fraction().bind(mean_unit);
    bone.distance().bind(distance_unit);
    // An integer sampler may not share a unit with a float one, so the unit is never left to chance.
    (bone.colour_code() ? *bone.colour_code() : bone.distance()).bind(code_unit);
    bone.colours().bind(colours_unit);
    (bone.surface_colours() != nullptr ? *bone.surface_colours() : bone.fraction()).bind(surface_unit);
    return program_;
}

}  // namespace osteomill
