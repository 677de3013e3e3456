#include "render_client/volume/passes/contact_shadow.h"

#include <fmt/format.h>

#include <glm/trigonometric.hpp>

#include "render_client/volume/passes/pixel_box.h"
#include "render_client/volume/shaders/camera_rays_shader.h"
#include "render_client/volume/shaders/lighting.h"

namespace osteomill {

namespace {

// Points relative to the burr's centre, in burr radii; patient axes.
constexpr const char* fragment_glsl = R"glsl(
uniform sampler2D bone_depth;
uniform vec2 picture_size;
uniform vec2 depth_terms;  // window depth = x + y / distance along forward
uniform vec3 eye;
uniform vec3 spindle_axis;
in vec3 ray;
out vec4 pixel;

const float reach = 6.0;             // radii beyond which nothing is darkened
const float shank_radius = 0.5;
const float shank_length = 6.0;
const float lamp_half_angle = 0.12;  // rad: how fast the shadow's edge widens

// How much of the lamp a ball takes: soft between the edges of core and half-shadow.
float shadow_of_ball(vec3 to_ball, float radius) {
    float along = dot(to_ball, key_direction);
    if (along <= 0.0) return 0.0;
    float aside = length(to_ball - along * key_direction);
    float half_shadow = lamp_half_angle * along;
    return 1.0 - smoothstep(radius - half_shadow, radius + half_shadow, aside);
}

void main() {
    float depth = texture(bone_depth, gl_FragCoord.xy / picture_size).r;
    if (depth >= 1.0) discard;
    vec3 point = eye + depth_terms.y / (depth - depth_terms.x) * ray;
    float away = length(point);
    if (away > reach) discard;
    // Where on the spindle the lamp's ray comes closest: the shank is a ball there.
    float lean = dot(spindle_axis, key_direction);
    float station = (dot(-point, key_direction) * lean + dot(point, spindle_axis)) / max(1.0 - lean * lean, 0.02);
    vec3 shank = clamp(station, 1.0, shank_length) * spindle_axis;
    float shadow = max(shadow_of_ball(-point, 1.0), shadow_of_ball(shank - point, shank_radius));
    float contact = 1.0 / max(away * away, 1.0);
    float fade = 1.0 - smoothstep(0.5 * reach, reach, away);
    float light = (1.0 - 0.5 * fade * shadow) * (1.0 - 0.55 * fade * contact);
    pixel = vec4(vec3(light), 1.0);
}
)glsl";

constexpr double reach_radii = 6.0;  // as in the shader
constexpr int depth_unit = 1;        // behind the colour

}  // namespace

ContactShadow::ContactShadow()
    : program_(camera_rays_vertex_glsl,
               fmt::format("#version 330 core\n{}{}", lighting_glsl, fragment_glsl)) {}

void ContactShadow::draw(const gl::Framebuffer& bone, const glm::dvec3& burr_mm, double radius_mm,
                         const glm::dvec3& spindle_axis, const Camera& camera, TileMask& covered) const {
    const glm::ivec2& size_px = covered.size_px();
    const double half_height = glm::tan(0.5 * camera.field_of_view_rad);
    const double half_width = half_height * size_px.x / size_px.y;
    const glm::dmat4 projection = camera.projection(size_px);
    program_.use();
    program_.set("bone_depth", depth_unit);
    program_.set("forward", glm::vec3(camera.forward()));
    program_.set("right", glm::vec3(half_width * camera.right()));
    program_.set("up", glm::vec3(half_height * camera.up()));
    program_.set("eye", glm::vec3((camera.eye_mm() - burr_mm) / radius_mm));
    program_.set("spindle_axis", glm::vec3(spindle_axis));
    program_.set("picture_size", glm::vec2(size_px));
    program_.set("depth_terms", glm::vec2(0.5 - 0.5 * projection[2][2], 0.5 * projection[3][2] / radius_mm));
    bone.bind_textures(depth_unit - 1);

    const double reach_mm = reach_radii * radius_mm;
    const auto pixels = pixels_of_box(camera, burr_mm - reach_mm, burr_mm + reach_mm, size_px);
    if (pixels) {
        covered.mark(*pixels);
        glEnable(GL_SCISSOR_TEST);
        glScissor(pixels->first.x, pixels->first.y, pixels->size.x, pixels->size.y);
    } else {
        covered.mark_all();
    }
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    full_screen_.draw();
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace osteomill
