#include "render_client/volume/passes/slice_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "render_client/volume/shaders/appearance_uniforms.h"
#include "render_client/volume/shaders/shader_files.h"

namespace osteomill {

namespace {

constexpr int light_unit = 0;  // no bone is sampled beside it

/// From voxels of the textures to patient space.
glm::dmat4 to_patient(const BoneTextures& bone) {
    const Grid& grid = bone.grid();
    const glm::dvec3 corner_mm =
        centre_of_voxel_mm(grid, bone.box().first) - glm::dvec3(0.5 * grid.spacing_mm);
    return glm::scale(glm::translate(glm::dmat4(1.0), corner_mm), glm::dvec3(grid.spacing_mm));
}

}  // namespace

SliceRenderer::SliceRenderer(const SliceSettings& settings)
    : settings_(settings), slice_program_(slice_files), blend_program_(make_program(gathered_light_files)) {}

void SliceRenderer::draw(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px) {
    // One voxel beyond the box on every side the fraction has fallen to zero.
    slices_.upload(view_slices(glm::dvec3(-1.0), glm::dvec3(bone.box().size) + 1.0,
                               bone.to_box_voxels(camera.eye_mm()), camera.forward(),
                               settings_.spacing_voxels));
    background_.draw(look(), size_px);
    if (bone.is_translucent())
        draw_translucent(bone, camera, size_px);
    else
        draw_slices(bone, camera, size_px, Pass::solid);
}

void SliceRenderer::draw_slices(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px,
                                Pass pass) {
    const gl::Program& program = slice_program_.use(bone, look());
    program.set("to_clip", glm::mat4(camera.projection(size_px) * camera.view() * to_patient(bone)));
    program.set("eye", glm::vec3(bone.to_box_voxels(camera.eye_mm())));
    program.set("forward", glm::vec3(camera.forward()));
    program.set("spacing", settings_.spacing_voxels);
    program.set("drawn_pass", static_cast<int>(pass));
    set_grain_uniforms(program, bone, camera, size_px);
    slices_.draw();
}

void SliceRenderer::draw_translucent(const BoneTextures& bone, const Camera& camera,
                                     const glm::ivec2& size_px) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_slices(bone, camera, size_px, Pass::depth);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);

    if (!light_ || light_->size_px() != size_px) light_.emplace(size_px);
    light_->begin();
    draw_slices(bone, camera, size_px, Pass::light);
    light_->end();

    blend_program_.use();
    blend_program_.set("light", light_unit);
    blend_program_.set("picture_size", glm::vec2(size_px));
    set_background_uniforms(blend_program_, look());
    light_->bind_texture(light_unit);
    glDisable(GL_DEPTH_TEST);
    blend_program_.fill_picture();
    glEnable(GL_DEPTH_TEST);
}

namespace {

/// Corners of a box by three bits, its edges by the corners at their ends.
constexpr std::array<std::array<unsigned, 2>, 12> edges{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

/// Puts the corners of a convex polygon in order round its middle.
void sort_round_middle(std::vector<glm::dvec3>& polygon, const glm::dvec3& normal) {
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& corner : polygon) middle += corner / static_cast<double>(polygon.size());
    const glm::dvec3 first = polygon.front() - middle;
    const glm::dvec3 second = glm::cross(normal, first);
    const auto angle = [&](const glm::dvec3& corner) {
        return std::atan2(glm::dot(corner - middle, second), glm::dot(corner - middle, first));
    };
    std::sort(polygon.begin(), polygon.end(),
              [&](const glm::dvec3& a, const glm::dvec3& b) { return angle(a) < angle(b); });
}

}  // namespace

std::vector<glm::vec3> view_slices(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& eye,
                                   const glm::dvec3& forward, double spacing) {
    if (!(spacing > 0.0)) throw std::invalid_argument("slices need a positive spacing");
    std::array<glm::dvec3, 8> corners{};
    std::array<double, 8> depths{};
    for (unsigned i = 0; i < 8; ++i) {
        corners[i] = {i & 1U ? high.x : low.x, i & 2U ? high.y : low.y, i & 4U ? high.z : low.z};
        depths[i] = glm::dot(corners[i] - eye, forward);
    }
    const auto [nearest, farthest] = std::minmax_element(depths.begin(), depths.end());
    const auto first = static_cast<long>(std::max(1.0, std::ceil(*nearest / spacing)));
    const auto last = static_cast<long>(std::floor(*farthest / spacing));

    std::vector<glm::vec3> triangles;
    std::vector<glm::dvec3> polygon;
    for (long slice = first; slice <= last; ++slice) {
        const double depth = spacing * static_cast<double>(slice);
        polygon.clear();
        for (const auto& [a, b] : edges) {
            if ((depths[a] < depth) == (depths[b] < depth)) continue;
            const double part = (depth - depths[a]) / (depths[b] - depths[a]);
            polygon.push_back(corners[a] + part * (corners[b] - corners[a]));
        }
        if (polygon.size() < 3) continue;
        sort_round_middle(polygon, forward);
        for (std::size_t i = 2; i < polygon.size(); ++i) {
            triangles.emplace_back(polygon[0]);
            triangles.emplace_back(polygon[i - 1]);
            triangles.emplace_back(polygon[i]);
        }
    }
    return triangles;
}

}  // namespace osteomill
