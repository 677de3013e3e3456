#include "studies/render/upload_cost.h"

#include <fmt/format.h>

namespace osteomill::study {

std::vector<UploadRow> measure_uploads(const TrialBone& trial, bool quick, const Progress& progress) {
    const std::vector<double> diameters_mm =
        quick ? std::vector{1.0, 3.0, 5.0} : std::vector{0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0};
    const int times = quick ? 5 : 25;
    // Bone that comes back is not what is measured, but without it there would be nothing new to upload.
    BoneTextures by_gradient(trial.bone, trial.tissues);
    BoneTextures by_voxels(trial.bone, trial.tissues, {.shading = Shading::surface_voxels});
    std::vector<UploadRow> rows;
    for (const double diameter_mm : diameters_mm) {
        TrialBone carved = trial;
        const auto bricks = carve_in_view(carved, diameter_mm);
        const auto cost = [&](BoneTextures& textures) {
            return median_cost([&] { textures.update(trial.bone, bricks); },
                               [&] { textures.update(carved.bone, bricks); }, times);
        };
        rows.push_back({.diameter_mm = diameter_mm,
                        .bricks = bricks.size(),
                        .gradient = cost(by_gradient),
                        .surface_voxels = cost(by_voxels)});
        progress(static_cast<double>(rows.size()) / static_cast<double>(diameters_mm.size()));
    }
    return rows;
}

std::string csv_of(const std::vector<UploadRow>& rows) {
    std::string csv =
        "diameter_mm,bricks,gradient_ms,gradient_cpu_ms,surface_voxels_ms,surface_voxels_cpu_ms\n";
    for (const UploadRow& r : rows)
        csv += fmt::format("{},{},{:.4f},{:.4f},{:.4f},{:.4f}\n", r.diameter_mm, r.bricks, r.gradient.wall_ms,
                           r.gradient.cpu_ms, r.surface_voxels.wall_ms, r.surface_voxels.cpu_ms);
    return csv;
}

}  // namespace osteomill::study
