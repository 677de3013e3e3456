#include "render_client/volume/shaders/appearance_uniforms.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render_client/volume/shading_settings.h"

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

void set_sawn_uniforms(const gl::Program& program, const BoneTextures& bone) {
    const glm::dvec3 first(bone.box().first);
    program.set("sawn_low", glm::vec3(bone.sawn_faces().low - first));
    program.set("sawn_high", glm::vec3(bone.sawn_faces().high - first));
}

void set_grain_uniforms(const gl::Program& program, const BoneTextures& bone, const Camera& camera,
                        const glm::ivec2& size_px) {
    const Grid& grid = bone.grid();
    const double pixel_mm = mm_per_px_at(camera, camera.target_mm, size_px);
    // A cell of two pixels or more shows the grain. A cell of one pixel would be noise that flickers as the
    // view turns.
    const auto seen = [&](double cell_mm) { return glm::clamp(cell_mm / pixel_mm - 1.0, 0.0, 1.0); };
    program.set("grain_corner_mm",
                glm::vec3(centre_of_voxel_mm(grid, bone.box().first) - 0.5 * grid.spacing_mm));
    program.set("grain_seen", glm::vec2(seen(fine_grain_mm), seen(coarse_grain_mm)));
}

}  // namespace osteomill
