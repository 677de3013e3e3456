#include "studies/render/frame_scaling.h"

#include <fmt/format.h>

namespace osteomill::study {

namespace {

ScaledFrames frames_of(double at, const TrialBone& trial, const glm::ivec2& size_px, bool quick) {
    const auto raycast = make_renderer(RendererChoice::raycast);
    const auto slices = make_renderer(RendererChoice::slices);
    const auto cost = [&](BoneRenderer& renderer, const BoneTextures& textures, int times) {
        return timed_drawing(renderer, textures, trial.overview, size_px, times).cost;
    };
    const int times = quick ? 3 : 7;
    ScaledFrames row{.at = at};
    {
        const BoneTextures textures(trial.bone, trial.tissues);
        row.raycast = cost(*raycast, textures, times);
        row.slices = cost(*slices, textures, 0);
    }
    const BoneTextures textures(trial.bone, trial.tissues, {.shading = Shading::surface_voxels});
    row.raycast_surface_voxels = cost(*raycast, textures, times);
    return row;
}

}  // namespace

std::vector<ScaledFrames> frames_by_volume(const glm::ivec2& size_px, bool quick, const Progress& progress) {
    std::vector<ScaledFrames> rows;
    const std::vector<int> edges =
        quick ? std::vector{64, 128, 192} : std::vector{64, 96, 128, 192, 256, 384};
    for (const int edge : edges) {
        rows.push_back(frames_of(edge, gyroid_trial(edge), size_px, quick));
        progress(static_cast<double>(rows.size()) / static_cast<double>(edges.size()));
    }
    return rows;
}

std::vector<ScaledFrames> frames_by_window(const TrialBone& trial, bool quick, const Progress& progress) {
    std::vector<ScaledFrames> rows;
    std::vector<glm::ivec2> sizes{{160, 120}, {320, 240}, {480, 360}};
    if (!quick) sizes.insert(sizes.end(), {{640, 480}, {800, 600}, {1280, 960}});
    for (const glm::ivec2& size_px : sizes) {
        rows.push_back(frames_of(1e-3 * size_px.x * size_px.y, trial, size_px, quick));
        progress(static_cast<double>(rows.size()) / static_cast<double>(sizes.size()));
    }
    return rows;
}

std::string csv_of(const std::vector<ScaledFrames>& rows, const std::string& at) {
    std::string csv = at +
                      ",raycast_ms,raycast_cpu_ms,raycast_surface_voxels_ms,raycast_surface_voxels_cpu_ms,"
                      "slices_ms,slices_cpu_ms\n";
    for (const ScaledFrames& r : rows)
        csv += fmt::format("{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f}\n", r.at, r.raycast.wall_ms,
                           r.raycast.cpu_ms, r.raycast_surface_voxels.wall_ms,
                           r.raycast_surface_voxels.cpu_ms, r.slices.wall_ms, r.slices.cpu_ms);
    return csv;
}

}  // namespace osteomill::study
