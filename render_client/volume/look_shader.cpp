#include "render_client/volume/look_shader.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

namespace osteomill {

void set_look_uniforms(const gl::Program& program, const SceneLook& look, const BoneTextures& bone) {
    const std::size_t cuts = std::min(look.cuts.size(), most_cut_planes);
    program.set("cut_count", static_cast<int>(cuts));
    for (std::size_t i = 0; i < cuts; ++i) {
        const CutPlane& cut = look.cuts[i];
        const glm::dvec3 on_plane = bone.to_box_voxels(cut.offset_mm * cut.normal);
        program.set(fmt::format("cut_planes[{}]", i).c_str(),
                    glm::vec4(cut.normal, glm::dot(cut.normal, on_plane)));
    }
    program.set("background_low", look.background_low);
    program.set("background_high", look.background_high);
}

}  // namespace osteomill
