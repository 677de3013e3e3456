#include "studies/render/zooms.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/passes/renderer_choice.h"
#include "render_client/volume/png_file.h"

namespace osteomill::study {

namespace {

constexpr double hole_mm = 5.0;
constexpr double from_above_rad = 1.1;

struct NamedLook {
    std::string suffix{};
    ShadingSettings look{};
};

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

class ZoomPictures {
  public:
    ZoomPictures(const glm::ivec2& size_px, const std::filesystem::path& folder)
        : size_px_(size_px), folder_(folder), framebuffer_(size_px) {}

    void write(TrialBone trial, const NamedLook& named) {
        BoneTextures textures(trial.bone, trial.tissues, named.look);
        Camera above = trial.close_up;
        above.elevation_rad = from_above_rad;
        write(textures, trial.overview, trial.name + named.suffix + "_whole");
        write(textures, at_zoom(above, trial, 10.0, size_px_), trial.name + named.suffix + "_10");
        textures.update(trial.bone, carve_in_view(trial, hole_mm));
        write(textures, at_zoom(above, trial, 20.0, size_px_), trial.name + named.suffix + "_20");
    }

  private:
    void write(const BoneTextures& textures, const Camera& camera, const std::string& name) {
        framebuffer_.bind();
        make_renderer(RendererChoice::raycast)->draw(textures, camera, size_px_);
        std::string file = name + ".png";
        std::ranges::replace(file, ' ', '_');
        write_png(framebuffer_.read_back(), folder_ / file);
    }

    glm::ivec2 size_px_;
    std::filesystem::path folder_;
    gl::Framebuffer framebuffer_;
};

}  // namespace

void write_zooms(const glm::ivec2& size_px, const std::filesystem::path& folder,
                 const std::optional<std::filesystem::path>& scans, const ReportProgress& progress) {
    ZoomPictures pictures(size_px, folder);
    const std::vector<NamedLook> all{{"", {}},
                                     {"_surface-voxels", {.shading = Shading::surface_voxels}},
                                     {"_tooth-look", {.transfer = preset("tooth")}},
                                     {"_ct-window", {.transfer = preset("ct-window")}}};
    const TrialBone tooth = tooth_trial();
    for (const NamedLook& look : all) pictures.write(tooth, look);
    progress(0.4);
    for (const char* const name : {"cube", "head"}) pictures.write(phantom_trial(name), all.front());
    progress(0.6);
    if (!scans) return;
    const TrialBone skull = skull_trial(*scans, folder);
    for (const NamedLook& look : all) pictures.write(skull, look);
    pictures.write(vault_trial(*scans, folder), all.front());
    progress(1.0);
}

}  // namespace osteomill::study
