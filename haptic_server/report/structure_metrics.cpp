#include "haptic_server/report/structure_metrics.h"

#include <algorithm>
#include <limits>

#include "haptic_server/report/nearest_place.h"
#include "haptic_server/report/voxel_set.h"

namespace osteomill {

namespace {

std::vector<glm::dvec3> surface_of(const Bone& bone, std::uint8_t label) {
    VoxelSet voxels(bone);
    if (bone.content().tissue.empty()) return {};
    for (std::int32_t slot = 0; slot < static_cast<std::int32_t>(bone.stored_bricks()); ++slot) {
        const ByteBrick& labels = bone.content().tissue[static_cast<std::size_t>(slot)];
        const BrickFractions fractions = bone.fractions(slot);
        for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel)
            if (labels[voxel] == label && fractions[voxel] > 0) voxels.set(slot, voxel);
    }
    return voxels.surface_mm();
}

std::optional<double> nearest_mm(const SessionTrace& trace, std::uint8_t label) {
    const std::vector<glm::dvec3> surface = surface_of(trace.at_start, label);
    if (surface.empty() || trace.samples.empty()) return std::nullopt;
    const NearestPlace place(surface);
    double nearest = std::numeric_limits<double>::infinity();
    for (const TraceSample& sample : trace.samples) {
        const double radius_mm = trace.session.burrs[sample.burr].radius_mm();
        nearest = std::min(nearest, *place.distance_mm(sample.burr_mm) - radius_mm);
    }
    return std::max(0.0, nearest);
}

}  // namespace

std::vector<StructureMetrics> structure_metrics(const SessionTrace& trace) {
    std::vector<StructureMetrics> all;
    for (const Tissue& tissue : trace.session.tissues) {
        if (!tissue.is_protected) continue;
        StructureMetrics metrics{.name = tissue.name, .nearest_mm = nearest_mm(trace, tissue.label)};
        std::int64_t gone = 0;
        std::int64_t undone = 0;
        double last_touch_s = -std::numeric_limits<double>::infinity();
        for (const TraceSample& sample : trace.samples)
            for (const TissueLevels& levels : sample.levels) {
                if (levels.tissue != tissue.label) continue;
                gone += levels.milled - levels.restored;
                undone += levels.restored;
                if (levels.milled <= 0) continue;
                if (sample.time_s > last_touch_s + touch_gap_s) ++metrics.touches;
                if (!metrics.first_touch_s) metrics.first_touch_s = sample.time_s;
                last_touch_s = sample.time_s;
            }
        metrics.dose_mm3 = trace.mm3(gone);
        metrics.undone_dose_mm3 = trace.mm3(undone);
        if (metrics.touches > 0) metrics.nearest_mm = 0.0;  // between two frames, too
        all.push_back(std::move(metrics));
    }
    return all;
}

}  // namespace osteomill
