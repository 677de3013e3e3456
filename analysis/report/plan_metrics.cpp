#include "analysis/report/plan_metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "analysis/report/planned_region.h"
#include "analysis/report/voxel_set.h"
#include "common/statistics/percentile.h"
#include "common/words/translation.h"

namespace osteomill {

namespace {

std::string length_text(double length_mm) {
    return spoken_number("{:.3g}", length_mm);
}

void add_distances(const std::vector<glm::dvec3>& from, const std::vector<glm::dvec3>& to,
                   std::vector<double>& distances_mm) {
    const NearestPlace nearest(to);
    for (const glm::dvec3& place : from) distances_mm.push_back(*nearest.distance_mm(place));
}

std::optional<SurfaceDistance> surface_distance(const VoxelSet& planned, const VoxelSet& cavity) {
    const std::vector<glm::dvec3> a = planned.boundary_mm();
    const std::vector<glm::dvec3> b = cavity.boundary_mm();
    if (a.empty() || b.empty()) return std::nullopt;
    std::vector<double> distances_mm;
    distances_mm.reserve(a.size() + b.size());
    add_distances(a, b, distances_mm);
    add_distances(b, a, distances_mm);
    const double sum_mm = std::accumulate(distances_mm.begin(), distances_mm.end(), 0.0);
    return SurfaceDistance{.mean_mm = sum_mm / static_cast<double>(distances_mm.size()),
                           .p95_mm = percentile(distances_mm, 0.95),
                           .hausdorff_mm = *std::ranges::max_element(distances_mm)};
}

}  // namespace

std::optional<PlanMetrics> plan_metrics(const SessionTrace& trace) {
    if (!trace.session.plan) return std::nullopt;
    const Bone& start = trace.at_start;
    const PlannedRegion region(start, trace.session);
    PlanMetrics metrics{.margin_mm = trace.session.plan->margin_mm};
    std::int64_t planned = 0;
    std::int64_t removed = 0;
    std::int64_t outside = 0;
    std::int64_t excess = 0;
    region.voxels().for_each([&](std::int32_t slot, std::size_t offset, const glm::ivec3&) {
        planned += start.fractions(slot)[offset];
    });
    const BoneContent& content = start.content();
    for (std::int32_t slot = 0; slot < static_cast<std::int32_t>(start.stored_bricks()); ++slot) {
        const BrickFractions before = start.fractions(slot);
        const BrickFractions after = trace.at_end.fractions(slot);
        if (std::ranges::equal(before, after)) continue;
        const glm::ivec3 first =
            brick_edge_voxels *
            brick_position(content.size_bricks, content.brick_of_slot[static_cast<std::size_t>(slot)]);
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
            const int lost = int{before[offset]} - int{after[offset]};
            if (lost == 0) continue;
            const glm::ivec3 voxel = first + voxel_in_brick(offset);
            if (region.voxels().contains(slot, offset)) {
                removed += lost;
            } else {
                outside += lost;
                if (region.distance_mm(centre_of_voxel_mm(start.grid(), voxel)) > metrics.margin_mm)
                    excess += lost;
            }
        }
    }
    metrics.planned_mm3 = trace.mm3(planned);
    metrics.removed_mm3 = trace.mm3(removed);
    metrics.removed_share = planned > 0 ? static_cast<double>(removed) / static_cast<double>(planned) : 0.0;
    metrics.outside_mm3 = trace.mm3(outside);
    metrics.excess_mm3 = trace.mm3(excess);
    metrics.surface = surface_distance(region.voxels(), cavity_of(trace.at_start, trace.at_end));
    return metrics;
}

std::string describe(const Plan& plan) {
    if (const auto* tissue = std::get_if<TissueRegion>(&plan.region)) return tissue_words(tissue->tissue);
    if (const auto* sphere = std::get_if<SphereRegion>(&plan.region))
        return trf("a sphere of {} mm radius", length_text(sphere->radius_mm));
    const auto& cylinder = std::get<CylinderRegion>(plan.region);
    return trf("a cylinder of {} mm radius, {} mm long", length_text(cylinder.radius_mm),
               length_text(glm::length(cylinder.to_mm - cylinder.from_mm)));
}

}  // namespace osteomill
