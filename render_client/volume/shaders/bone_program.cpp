#include "render_client/volume/shaders/bone_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>

#include "render_client/volume/shaders/appearance_uniforms.h"
#include "render_client/volume/shaders/shader_files.h"

namespace osteomill {

namespace {

enum TextureUnit {
    fraction_unit,
    blocks_unit,
    table_unit,
    code_unit,
    colours_unit,
    surface_unit,
    ct_unit,
    smoothed_unit,
    seen_unit,
    seen_looks_unit
};

bool shows_ct(const SceneAppearance& look) {
    return look.ct != nullptr && !look.cuts.empty();
}

std::string constant(const char* name, bool value) {
    return fmt::format("const bool {} = {};\n", name, value);
}

}  // namespace

gl::Program BoneProgram::make(const Variant& variant) const {
    std::array<std::string_view, 1 + bone_sampling_files.size() + std::size(ProgramFiles{}.fragment)> files{
        variant.layout == BoneLayout::dense ? "dense_places.glsl" : "atlas_places.glsl"};
    auto* const own = std::ranges::copy(bone_sampling_files, files.begin() + 1).out;
    std::ranges::copy(own_.fragment, own);
    const std::string constants = constant("bone_has_colour_code", variant.has_colour_code) +
                                  constant("bone_codes_are_mostly_alike", variant.codes_are_mostly_alike) +
                                  constant("bone_has_smoothed", variant.has_smoothed) +
                                  constant("bone_has_surface_colours", variant.has_surface_colours) +
                                  constant("bone_is_translucent", variant.is_translucent) +
                                  constant("bone_is_occluded", variant.is_occluded) +
                                  constant("bone_shows_through", variant.shows_through) +
                                  constant("bone_shines", variant.shines) +
                                  constant("bone_has_grain", variant.has_grain) +
                                  constant("bone_has_sawn_faces", variant.has_sawn_faces) +
                                  constant("cuts_show_ct", variant.cuts_show_ct) +
                                  fmt::format("const int cut_count = {};\n", variant.cut_count);
    gl::Program program = make_program(shader_text({&own_.vertex, 1}), shader_text(files, constants));
    program.use();
    program.set("bone_fraction", fraction_unit);
    program.set("bone_blocks", blocks_unit);
    program.set("bone_tile_table", table_unit);
    program.set("bone_colour_code", code_unit);
    program.set("bone_colours", colours_unit);
    program.set("bone_surface_colours", surface_unit);
    program.set("cut_ct", ct_unit);
    program.set("bone_smoothed", smoothed_unit);
    program.set("bone_seen", seen_unit);
    program.set("bone_seen_looks", seen_looks_unit);
    return program;
}

const gl::Program& BoneProgram::program_for(const Variant& variant) {
    for (const auto& [known, program] : programs_)
        if (known == variant) return program;
    return programs_.emplace_back(variant, make(variant)).second;
}

const gl::Program& BoneProgram::use(const BoneTextures& bone, const SceneAppearance& look) {
    const SeenThrough* seen = look.thin_bone ? bone.seen_through() : nullptr;
    const gl::Program& program =
        program_for({.layout = bone.plan().layout,
                     .has_colour_code = bone.colour_code().has_value(),
                     .codes_are_mostly_alike = bone.codes_are_mostly_alike(),
                     .has_smoothed = bone.smoothed() != nullptr,
                     .has_surface_colours = bone.surface_colours() != nullptr,
                     .is_translucent = bone.is_translucent(),
                     .is_occluded = look.ambient_occlusion,
                     .shows_through = seen != nullptr,
                     .shines = look.specular > 0.0f,
                     .has_grain = look.grain,
                     .has_sawn_faces = look.neutral_sawn_faces && bone.sawn_faces().any(),
                     .cut_count = cut_count(look),
                     .cuts_show_ct = shows_ct(look)});
    program.use();
    program.set("bone_size", glm::vec3(bone.box().size));
    program.set("bone_texture_size", glm::vec3(bone.fraction().size()));
    program.set("bone_mm_per_voxel", static_cast<float>(bone.grid().spacing_mm));
    program.set("bone_colour_depth", static_cast<float>(bone.colour_depth_voxels()));
    program.set("specular", look.specular);
    set_cut_uniforms(program, look, bone);
    set_sawn_uniforms(program, bone);
    bone.fraction().bind(fraction_unit);
    bone.blocks().bind(blocks_unit);
    bone.colours().bind(colours_unit);
    if (bone.tile_table()) bone.tile_table()->bind(table_unit);
    if (bone.smoothed() != nullptr) bone.smoothed()->bind(smoothed_unit);
    if (bone.surface_colours() != nullptr) bone.surface_colours()->bind(surface_unit);
    // Even an unused sampler must not find a texture of another kind on its unit.
    if (bone.colour_code())
        bone.colour_code()->bind(code_unit);
    else
        gl::Texture3D::unbind(code_unit);
    if (seen != nullptr)
        bind_seen(program, bone, *seen);
    else
        gl::Texture3D::unbind(seen_unit);
    if (shows_ct(look))
        bind_ct(program, bone, look);
    else
        gl::Texture3D::unbind(ct_unit);
    return program;
}

void BoneProgram::bind_seen(const gl::Program& program, const BoneTextures& bone, const SeenThrough& seen) {
    const glm::dvec3 places(seen.lattice().places);
    const double step = seen.lattice().step;
    program.set("seen_step", static_cast<float>(step));
    program.set("seen_per_voxel", static_cast<float>(1.0 / step));
    // Places are centres of texels, and of voxels; the first is one step before the box.
    program.set("seen_scale", glm::vec3(1.0 / (step * places)));
    program.set("seen_shift", glm::vec3((1.5 - 0.5 / step) / places));
    program.set("seen_farthest", static_cast<float>(seen.farthest_voxels()));
    program.set("seen_span", static_cast<float>(seen.span_voxels()));
    seen.texture().bind(seen_unit);
    bone.seen_looks().bind(seen_looks_unit);
}

void BoneProgram::bind_ct(const gl::Program& program, const BoneTextures& bone, const SceneAppearance& look) {
    const Grid& grid = look.ct->grid;
    if (!ct_ || ct_->ct != look.ct)
        ct_ = std::make_unique<CtTexture>(
            CtTexture{look.ct,
                      {.level_hu = std::nan(""), .window_hu = 0.0},
                      gl::Texture3D(gl::VoxelFormat::interpolated_byte, grid.size_voxels)});
    if (ct_->window != look.ct_window) {
        std::vector<std::uint8_t> grey(look.ct->hu.size());
        std::ranges::transform(look.ct->hu, grey.begin(),
                               [&](std::int16_t hu) { return look.ct_window.grey(hu); });
        ct_->grey.upload(glm::ivec3(0), grid.size_voxels, grey);
        ct_->window = look.ct_window;
    }
    const glm::dvec3 half_mm(0.5 * grid.spacing_mm);
    const glm::dvec3 first = bone.to_box_voxels(grid.origin_mm - half_mm);
    const glm::dvec3 end = bone.to_box_voxels(centre_of_voxel_mm(grid, grid.size_voxels - 1) + half_mm);
    program.set("cut_ct_origin", glm::vec3(first));
    program.set("cut_ct_scale", glm::vec3(1.0 / (end - first)));
    ct_->grey.bind(ct_unit);
}

}  // namespace osteomill
