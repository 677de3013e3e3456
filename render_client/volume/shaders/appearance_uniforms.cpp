#include "render_client/volume/shaders/appearance_uniforms.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

namespace osteomill {

int cut_count(const SceneAppearance& look) {
    return static_cast<int>(std::min(look.cuts.size(), most_cut_planes));
}

void set_background_uniforms(const gl::Program& program, const SceneAppearance& look) {
    program.set("background_low", look.background_low);
    program.set("background_high", look.background_high);
}

void set_cut_uniforms(const gl::Program& program, const SceneAppearance& look, const BoneTextures& bone) {
    for (int i = 0; i < cut_count(look); ++i) {
        const CutPlane& cut = look.cuts[static_cast<std::size_t>(i)];
        const glm::dvec3 on_plane = bone.to_box_voxels(cut.offset_mm * cut.normal);
        program.set(fmt::format("cut_planes[{}]", i).c_str(),
                    glm::vec4(cut.normal, glm::dot(cut.normal, on_plane)));
    }
}

}  // namespace osteomill
