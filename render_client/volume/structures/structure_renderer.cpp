#include "render_client/volume/structures/structure_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/ext/matrix_transform.hpp>

#include "render_client/volume/shaders/shader_files.h"

namespace osteomill {

std::size_t StructureRenderer::add(const StructureSurface& surface, double opacity) {
    Drawn& added = drawn_.emplace_back();
    if (surface.triangles.indices.empty() || opacity <= 0.0) return drawn_.size() - 1;
    if (!program_) {
        const std::string cut_count = fmt::format("const int cut_count = {};\n", most_cut_planes);
        program_ = make_program(shader_text({&structure_files.vertex, 1}),
                                shader_text(structure_files.fragment, cut_count));
    }
    added.mesh.emplace(surface.triangles);
    added.origin_mm = surface.origin_mm;
    added.opacity = static_cast<float>(opacity);
    return drawn_.size() - 1;
}

// First the depth of the nearest surface, then its colour: light passes a structure only once, in whatever
// order the triangles come.
void StructureRenderer::draw(const Camera& camera, const SceneAppearance& look, TileMask& covered) {
    if (!program_) return;
    const glm::dmat4 view_projection = camera.projection(covered.size_px()) * camera.view();
    program_->use();
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    for (const Drawn& one : drawn_) {
        if (!one.mesh || !one.is_shown) continue;
        const glm::dmat4 to_clip = view_projection * glm::translate(glm::dmat4(1.0), one.origin_mm);
        mark_box(covered, one.mesh->low(), one.mesh->high(), to_clip);
        program_->set("to_clip", glm::mat4(to_clip));
        program_->set("opacity", one.opacity);
        for (std::size_t i = 0; i < most_cut_planes; ++i) {
            glm::vec4 plane(0.0f, 0.0f, 0.0f, 1.0f);  // takes nothing away
            if (i < look.cuts.size())
                plane = {look.cuts[i].normal,
                         look.cuts[i].offset_mm - glm::dot(look.cuts[i].normal, one.origin_mm)};
            program_->set(fmt::format("cut_planes[{}]", i).c_str(), plane);
        }
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        one.mesh->draw();
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        one.mesh->draw();
    }
    glDisable(GL_BLEND);
    glDepthFunc(GL_LESS);
}

}  // namespace osteomill
