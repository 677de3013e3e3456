#include "studies/render/gallery.h"

#include <algorithm>

#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/passes/renderer_choice.h"
#include "render_client/volume/png_file.h"

namespace osteomill::study {

namespace {

constexpr double burr_mm = 5.0;

std::string file_name(std::string name) {
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
}

}  // namespace

void write_gallery(const TrialBone& trial, const glm::ivec2& size_px, const std::filesystem::path& folder) {
    const gl::Framebuffer framebuffer(size_px);
    const auto write = [&](RendererChoice choice, const BoneTextures& textures, const Camera& camera,
                           const std::string& name) {
        framebuffer.bind();
        make_renderer(choice)->draw(textures, camera, size_px);
        write_png(framebuffer.read_back(), folder / (file_name(trial.name + "_" + name) + ".png"));
    };
    for (const auto& each :
         {std::pair{Shading::gradient, "gradient"}, std::pair{Shading::surface_voxels, "surface_voxels"}}) {
        const char* const shading_name = each.second;
        BoneTextures textures(trial.bone, trial.tissues, {.shading = each.first});
        TrialBone carved = trial;
        const auto write_both = [&](const std::string& moment) {
            for (const auto& [choice, choice_name] :
                 {std::pair{RendererChoice::raycast, "raycast"}, std::pair{RendererChoice::slices, "slices"}})
                write(choice, textures, trial.close_up,
                      std::string(choice_name) + "_" + shading_name + "_" + moment);
        };
        write_both("before");
        textures.update(carved.bone, carve_in_view(carved, burr_mm));
        write_both("after");
    }
    for (const TransferFunction& preset : transfer_presets()) {
        const BoneTextures textures(trial.bone, trial.tissues, {.transfer = preset});
        write(RendererChoice::raycast, textures, trial.close_up, "transfer_" + preset.name);
    }
}

}  // namespace osteomill::study
