#include "studies/render/zooms.h"

#include <algorithm>
#include <cmath>

#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/passes/renderer_choice.h"
#include "render_client/volume/png_file.h"

namespace osteomill::study {

namespace {

constexpr double hole_mm = 5.0;
constexpr double from_above_rad = 1.1;

const TransferFunction& preset(std::string_view name) {
    return *std::ranges::find(transfer_presets(), name, &TransferFunction::name);
}

/// The camera, so far away that a voxel at its target is that many pixels.
Camera at_zoom(Camera camera, const TrialBone& trial, double px_per_voxel, const glm::ivec2& size_px) {
    camera.distance_mm = 0.5 * size_px.y / px_per_voxel * trial.bone.grid().spacing_mm /
                         std::tan(0.5 * camera.field_of_view_rad);
    camera.near_mm = 0.1 * camera.distance_mm;
    return camera;
}

}  // namespace

std::vector<ZoomCase> zoom_cases(bool with_scans) {
    std::vector<ZoomCase> cases;
    const auto add_all_looks = [&](const char* bone) {
        cases.push_back({bone});
        cases.push_back({bone, "_surface-voxels", {.shading = Shading::surface_voxels}});
        cases.push_back({bone, "_tooth-look", {.transfer = preset("tooth")}});
        cases.push_back({bone, "_ct-window", {.transfer = preset("ct-window")}});
    };
    add_all_looks(tooth_trial);
    cases.push_back({cube_trial});
    cases.push_back({head_trial});
    if (!with_scans) return cases;
    add_all_looks(skull_trial);
    cases.push_back({vault_trial});
    return cases;
}

std::filesystem::path write_zooms(const ZoomCase& c, TrialBones& bones, const glm::ivec2& size_px,
                                  const std::filesystem::path& folder) {
    TrialBone trial = bones[c.bone];
    BoneTextures textures(trial.bone, trial.tissues, c.look);
    gl::Framebuffer framebuffer(size_px);
    const auto write = [&](const Camera& camera, const char* zoom) {
        framebuffer.bind();
        make_renderer(RendererChoice::raycast)->draw(textures, camera, size_px);
        std::string file = c.bone + c.suffix + zoom;
        std::ranges::replace(file, ' ', '_');
        write_png(framebuffer.read_back(), folder / file);
        return folder / file;
    };
    Camera above = trial.close_up;
    above.elevation_rad = from_above_rad;
    const std::filesystem::path whole = write(trial.overview, "_whole.png");
    write(at_zoom(above, trial, 10.0, size_px), "_10.png");
    textures.update(trial.bone, carve_in_view(trial, hole_mm));
    write(at_zoom(above, trial, 20.0, size_px), "_20.png");
    return whole;
}

}  // namespace osteomill::study
