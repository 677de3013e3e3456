#include "render_client/volume/raycast_renderer.h"

#include <glm/trigonometric.hpp>
#include <string>

#include "render_client/volume/lighting.h"
#include "render_client/volume/raycast_shader.h"

namespace osteomill {

namespace {

enum TextureUnit { fraction_unit, mean_unit, distance_unit, code_unit, colours_unit };

/// A chord through bone shorter than this may be missed; a longer step was not worth its speed.
constexpr float step_voxels = 0.75f;

gl::Program make_program() {
    return {raycast_vertex_glsl,
            std::string(raycast_fragment_head_glsl) + lighting_glsl + raycast_fragment_glsl};
}

/// Window depth as a function of the distance along the camera's axis, from the projection matrix.
glm::vec2 depth_terms(const Camera& camera, double spacing_mm, const glm::ivec2& size_px) {
    const glm::dmat4 projection = camera.projection(size_px);
    return {0.5 - 0.5 * projection[2][2], 0.5 * projection[3][2] / spacing_mm};
}

}  // namespace

RaycastRenderer::RaycastRenderer(EmptySpaceSkipping skipping)
    : program_(make_program()), skipping_(skipping) {
    program_.use();
    program_.set("fraction", fraction_unit);
    program_.set("mean_fraction", mean_unit);
    program_.set("skip_distance", distance_unit);
    program_.set("colour_code", code_unit);
    program_.set("colours", colours_unit);
    program_.set("step_length", step_voxels);
    program_.set("skips", skipping == EmptySpaceSkipping::distance_map ? 1 : 0);
}

void RaycastRenderer::draw(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px) {
    const double half_height = glm::tan(0.5 * camera.field_of_view_rad);
    const double half_width = half_height * size_px.x / size_px.y;
    program_.use();
    program_.set("forward", glm::vec3(camera.forward()));
    program_.set("right", glm::vec3(half_width * camera.right()));
    program_.set("up", glm::vec3(half_height * camera.up()));
    program_.set("eye", glm::vec3(bone.to_box_voxels(camera.eye_mm())));
    program_.set("size", glm::vec3(bone.box().size));
    program_.set("picture_size", glm::vec2(size_px));
    program_.set("depth_terms", depth_terms(camera, bone.grid().spacing_mm, size_px));
    program_.set("has_colour_code", bone.colour_code() ? 1 : 0);
    program_.set("code_zero_is_unknown", bone.colour_code() ? 1 : 0);

    bone.fraction().bind(fraction_unit);
    bone.mean_fraction().bind(mean_unit);
    bone.distance().bind(distance_unit);
    // An integer sampler may not share a unit with a float one, so the unit is never left to chance.
    (bone.colour_code() ? *bone.colour_code() : bone.distance()).bind(code_unit);
    bone.colours().bind(colours_unit);

    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    full_screen_.draw();
    glDepthFunc(GL_LESS);
}

}  // namespace osteomill
