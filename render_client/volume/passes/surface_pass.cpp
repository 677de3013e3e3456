#include "render_client/volume/passes/surface_pass.h"

#include <algorithm>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <stdexcept>
#include <utility>

#include "render_client/volume/passes/incremental_bone_pass.h"
#include "render_client/volume/shaders/bone_program.h"
#include "render_client/volume/shaders/shader_files.h"

namespace osteomill {

namespace {

void attach(GLuint buffer, GLenum format, const glm::ivec2& size_px, GLenum attachment) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffer);
    glRenderbufferStorage(GL_RENDERBUFFER, format, size_px.x, size_px.y);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
}

/// Patient axes to the camera's.
glm::mat3 to_camera(const Camera& camera) {
    return glm::transpose(glm::mat3(glm::dmat3(camera.right(), -camera.up(), camera.forward())));
}

/// OpenGL's rows begin at the bottom.
template <typename Value>
void turn_over(std::vector<Value>& pixels, int width) {
    for (auto low = pixels.begin(), high = pixels.end() - width; low < high; low += width, high -= width)
        std::swap_ranges(low, low + width, high);
}

}  // namespace

SurfacePass::SurfacePass(const glm::ivec2& size_px)
    : size_px_(size_px),
      bone_program_(bone_surface_files),
      mesh_program_(make_program(mesh_surface_files)),
      head_(burr_head(burr_shape_)),
      shank_(burr_shank(burr_shape_)),
      covered_(size_px) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    attach(surface_, GL_RGBA32F, size_px, GL_COLOR_ATTACHMENT0);
    attach(thing_, GL_R8UI, size_px, GL_COLOR_ATTACHMENT1);
    attach(depth_, GL_DEPTH_COMPONENT32F, size_px, GL_DEPTH_ATTACHMENT);
    constexpr GLenum both[]{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(2, both);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("the OpenGL driver cannot draw depths and labels of " +
                                 std::to_string(size_px.x) + " x " + std::to_string(size_px.y) + " pixels");
}

void SurfacePass::add_structure(const StructureSurface& surface, std::uint8_t thing) {
    if (!surface.triangles.indices.empty())
        structures_.push_back({gl::Mesh(surface.triangles), surface.origin_mm, thing});
}

SurfaceImage SurfacePass::draw(const BoneTextures& bone, const DrawnTool* tool, const Camera& camera) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, size_px_.x, size_px_.y);
    glEnable(GL_DEPTH_TEST);
    draw_bone(bone, camera);
    draw_meshes(tool, camera);
    return read_back();
}

void SurfacePass::draw_bone(const BoneTextures& bone, const Camera& camera) {
    constexpr float no_surface[]{0.0f, 0.0f, 0.0f, SurfaceImage::no_depth};
    constexpr GLuint no_thing[]{SurfaceImage::nothing, 0, 0, 0};
    constexpr float farthest = 1.0f;
    TileMask stale = std::exchange(covered_, TileMask(size_px_));
    stale |= tiles_of_changes(dirty_, bone, camera, size_px_, surface_reach_voxels);
    if (camera_ != camera) stale.mark_all();
    camera_ = camera;
    dirty_.clear();
    const gl::Program& program = bone_program_.use(bone, {});
    set_ray_uniforms(program, bone, camera, size_px_, {});
    program.set("to_camera", to_camera(camera));
    program.set("thing_number", SurfaceImage::bone);
    glEnable(GL_SCISSOR_TEST);
    for (const PixelBox& box : stale.rectangles()) {
        glScissor(box.first.x, box.first.y, box.size.x, box.size.y);
        glClearBufferfv(GL_COLOR, 0, no_surface);
        glClearBufferuiv(GL_COLOR, 1, no_thing);
        glClearBufferfv(GL_DEPTH, 0, &farthest);
        program.fill_picture();
    }
    glDisable(GL_SCISSOR_TEST);
}

void SurfacePass::draw_meshes(const DrawnTool* tool, const Camera& camera) {
    const glm::dmat4 view_projection = camera.projection(size_px_) * camera.view();
    mesh_program_.use();
    mesh_program_.set("eye", glm::vec3(camera.eye_mm()));
    mesh_program_.set("forward", glm::vec3(camera.forward()));
    mesh_program_.set("to_camera", to_camera(camera));
    const auto draw = [&](const gl::Mesh& mesh, const glm::dmat4& to_patient, std::uint8_t thing) {
        mesh_program_.set("to_clip", glm::mat4(view_projection * to_patient));
        mesh_program_.set("to_patient", glm::mat4(to_patient));
        mesh_program_.set("normal_to_patient", glm::mat3(to_patient));  // rigid
        mesh_program_.set("thing_number", thing);
        mesh.draw();
    };
    // They stay where they are: drawing them again has no effect.
    for (const Structure& structure : structures_)
        draw(structure.mesh, glm::translate(glm::dmat4(1.0), structure.origin_mm), structure.thing);
    if (tool == nullptr) return;
    if (tool->burr != burr_shape_) {
        burr_shape_ = tool->burr;
        head_ = gl::Mesh(burr_head(burr_shape_));
        shank_ = gl::Mesh(burr_shank(burr_shape_));
    }
    const glm::dmat4 at_burr = pose_of(*tool);
    for (const gl::Mesh* mesh : {&head_, &shank_}) {
        mark_box(covered_, mesh->low(), mesh->high(), view_projection * at_burr);
        draw(*mesh, at_burr, mesh == &head_ ? SurfaceImage::burr : SurfaceImage::shank);
    }
}

SurfaceImage SurfacePass::read_back() const {
    const auto pixels = static_cast<std::size_t>(size_px_.x) * static_cast<std::size_t>(size_px_.y);
    std::vector<glm::vec4> surface(pixels);
    SurfaceImage image;
    image.size_px = size_px_;
    image.thing.resize(pixels);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, size_px_.x, size_px_.y, GL_RGBA, GL_FLOAT, surface.data());
    glReadBuffer(GL_COLOR_ATTACHMENT1);
    glReadPixels(0, 0, size_px_.x, size_px_.y, GL_RED_INTEGER, GL_UNSIGNED_BYTE, image.thing.data());
    turn_over(surface, size_px_.x);
    turn_over(image.thing, size_px_.x);
    image.depth_mm.reserve(pixels);
    image.normal.reserve(pixels);
    for (const glm::vec4& pixel : surface) {
        image.depth_mm.push_back(pixel.w);
        image.normal.emplace_back(pixel);
    }
    return image;
}

}  // namespace osteomill
