#include "studies/render/accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <thread>

#include "render_client/volume/passes/slice_renderer.h"
#include "studies/render/picture_difference.h"

namespace osteomill::study {

namespace {

const ShadingSettings by_gradient{};
const ShadingSettings by_surface_voxels{.shading = Shading::surface_voxels};

/// As one sees through the tooth's bone.
const ShadingSettings& see_through() {
    static const ShadingSettings look{
        .transfer = *std::ranges::find(transfer_presets(), "tooth", &TransferFunction::name)};
    return look;
}

std::unique_ptr<BoneRenderer> renderer_of(const DrawingSetting& setting) {
    if (setting.renderer == RendererChoice::slices)
        return std::make_unique<SliceRenderer>(SliceSettings{.spacing_voxels = setting.step_voxels});
    return std::make_unique<RaycastRenderer>(RaycastSettings{
        .skipping = setting.skips ? EmptySpaceSkipping::distance_map : EmptySpaceSkipping::none,
        .step_voxels = setting.step_voxels});
}

Picture reference_of(const TrialBone& trial, const Camera& camera, const ShadingSettings& look,
                     const glm::ivec2& size_px) {
    return reference_image(ReferenceVolume(trial.bone, trial.tissues, look), camera, size_px,
                           {.threads = std::max(1u, std::thread::hardware_concurrency())});
}

/// Points of the same bone and view together, in the order in which these first come; so a chart has a panel
/// for each.
std::vector<DrawingPoint> by_panel(std::vector<DrawingPoint> points) {
    const auto first_like = [all = points](const DrawingPoint& point) {
        return std::find_if(all.begin(), all.end(),
                            [&](const DrawingPoint& other) {
                                return other.bone == point.bone && other.view == point.view;
                            }) -
               all.begin();
    };
    std::stable_sort(points.begin(), points.end(), [&](const DrawingPoint& a, const DrawingPoint& b) {
        return first_like(a) < first_like(b);
    });
    return points;
}

}  // namespace

std::vector<DrawingSetting> drawing_settings(bool quick) {
    std::vector<DrawingSetting> settings;
    const float usual = RaycastSettings{}.step_voxels;
    for (const float step : std::set{0.25f, 0.5f, usual, 1.0f, 2.0f}) {
        if (quick && step == 0.25f) continue;
        settings.push_back({.family = "rays shaded by gradient",
                            .label = fmt::format("step {}", step),
                            .look = by_gradient,
                            .step_voxels = step,
                            .is_default = step == usual});
        settings.push_back({.family = "rays to surface voxels",
                            .label = fmt::format("step {}", step),
                            .look = by_surface_voxels,
                            .step_voxels = step});
    }
    for (const float step : quick ? std::set{usual} : std::set{usual, 1.0f, 2.0f})
        settings.push_back({.family = "rays without skipping",
                            .label = fmt::format("step {}", step),
                            .step_voxels = step,
                            .skips = false});
    for (const float step : quick ? std::set{usual} : std::set{0.25f, usual, 1.0f})
        settings.push_back({.family = "rays through see-through bone",
                            .label = fmt::format("step {}", step),
                            .look = see_through(),
                            .step_voxels = step});
    for (const int divisor : {2, 3, 4})
        settings.push_back({.family = "rays at lower resolution",
                            .label = fmt::format("1 / {}", divisor),
                            .divisor = divisor});
    for (const float spacing : quick ? std::set{1.0f} : std::set{0.5f, 1.0f, 2.0f}) {
        settings.push_back({.family = "slices shaded by gradient",
                            .label = fmt::format("spacing {}", spacing),
                            .renderer = RendererChoice::slices,
                            .step_voxels = spacing});
        settings.push_back({.family = "slices of surface voxels (published)",
                            .label = fmt::format("spacing {}", spacing),
                            .renderer = RendererChoice::slices,
                            .look = by_surface_voxels,
                            .step_voxels = spacing});
    }
    return settings;
}

std::vector<std::vector<DrawingSetting>> by_look(const std::vector<DrawingSetting>& settings) {
    std::vector<std::vector<DrawingSetting>> groups;
    for (const DrawingSetting& setting : settings) {
        auto group = std::ranges::find_if(
            groups, [&](const auto& others) { return others.front().look == setting.look; });
        if (group == groups.end()) group = groups.insert(groups.end(), std::vector<DrawingSetting>{});
        group->push_back(setting);
    }
    return groups;
}

std::vector<Drawn> measure(const TrialBone& trial, const Camera& camera,
                           const std::vector<DrawingSetting>& settings, const glm::ivec2& size_px,
                           bool quick) {
    const ShadingSettings& look = settings.front().look;
    const BoneTextures textures(trial.bone, trial.tissues, look);
    const Picture reference = reference_of(trial, camera, look, size_px);
    std::vector<Drawn> all;
    for (const DrawingSetting& setting : settings) {
        // What takes seconds a frame is steady enough.
        const bool is_slow = setting.renderer == RendererChoice::slices || !setting.skips;
        const auto renderer = renderer_of(setting);
        const TimedPicture drawn =
            timed_drawing(*renderer, textures, camera, glm::max(size_px / setting.divisor, 1),
                          is_slow ? 0 : (quick ? 3 : 7));
        const Picture shown = setting.divisor == 1 ? drawn.picture : scaled(drawn.picture, size_px);
        all.push_back({.frame = drawn.cost,
                       .psnr_db = psnr_db(shown, reference),
                       .ssim = ssim(shown, reference)});
    }
    return all;
}

Table table_of(const std::vector<DrawingPoint>& points) {
    Table table({"panel_number", "panel", "bone", "view", "family", "label", "step_voxels", "skips",
                 "divisor", "frame_ms", "frame_cpu_ms", "psnr_db", "ssim", "is_default"});
    std::string panel;
    int panel_number = 0;
    for (const DrawingPoint& p : by_panel(points)) {
        if (panel != p.bone + " " + p.view) ++panel_number;
        panel = p.bone + " " + p.view;
        table.add({panel_number, panel, p.bone, p.view, p.setting.family, p.setting.label,
                   p.setting.step_voxels, p.setting.skips, p.setting.divisor, p.drawn.frame.wall_ms,
                   p.drawn.frame.cpu_ms, p.drawn.psnr_db, p.drawn.ssim, p.setting.is_default});
    }
    return table;
}

}  // namespace osteomill::study
