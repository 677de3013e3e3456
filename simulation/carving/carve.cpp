#include "simulation/carving/carve.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "simulation/carving/carve_kernel.h"
#include "simulation/carving/crescent_rows.h"

namespace osteomill {

namespace {

/// A sweep of at most CrescentRows::longest_step_voxels from where the ball has carved, or a ball at rest.
/// `changes`: null if the bone stays as it is.
void carve_short(Bone& bone, const Sweep& ball, const CarveSettings& settings, ChangeSink* changes,
                 RemovalSink& sink) noexcept {
    const glm::ivec3 size = bone.grid().size_voxels;
    const auto reach = static_cast<int>(std::ceil(ball.radius)) + 3;
    const glm::ivec3 near(glm::floor(0.5 * (ball.from + ball.to)));
    const glm::ivec3 base = ((near - reach) >> 4) * brick_edge_voxels;  // rounded down to a brick
    const glm::dvec3 origin(base);
    CrescentRows rows({ball.from - origin, ball.to - origin, ball.radius}, rim_voxels(settings.coverage),
                      glm::max(-base, glm::ivec3(0)), size - base);
    const VoxelRange slices = rows.slices();
    if (rows.columns().empty() || rows.rows().empty() || slices.empty()) return;

    CarveKernel kernel(bone, base, SweepSeenFrom(ball, origin, settings.coverage), settings, changes, sink);
    for (int first = slices.first; first < slices.end;) {
        const int end = std::min(slices.end, (first / brick_edge_voxels + 1) * brick_edge_voxels);
        const BrickLayer layer(bone, base, rows, first);
        for (int brick_y = layer.first_y(); brick_y < layer.end_y(); ++brick_y)
            if (layer.row_holds_any(brick_y)) kernel.carve_bricks(rows, layer, brick_y, {first, end});
        first = end;
    }
    kernel.hand_on_voxels();
}

}  // namespace

void carve(Bone& bone, const Sweep& ball, CarveHistory history, const CarveSettings& settings,
           ChangeSink& changes, RemovalSink& removed) noexcept {
    Sweep sweep = ball;
    if (!cut_to_grid(sweep, bone.grid().size_voxels)) return;
    if (history == CarveHistory::none)
        carve_short(bone, {sweep.from, sweep.from, sweep.radius}, settings, &changes, removed);
    const glm::dvec3 along = sweep.to - sweep.from;
    const double length = glm::length(along);
    if (length == 0.0) return;
    // A long sweep is a chain of short ones: each looks only at its own crescent.
    const double parts = std::ceil(length / CrescentRows::longest_step_voxels);
    glm::dvec3 from = sweep.from;
    for (double part = 1.0; part <= parts; part += 1.0) {
        const glm::dvec3 to = part == parts ? sweep.to : sweep.from + along * (part / parts);
        carve_short(bone, {from, to, sweep.radius}, settings, &changes, removed);
        from = to;
    }
}

void preview_carve(Bone& bone, const Sweep& ball, const CarveSettings& settings,
                   RemovalSink& would_go) noexcept {
    Sweep sweep = ball;
    if (cut_to_grid(sweep, bone.grid().size_voxels)) carve_short(bone, sweep, settings, nullptr, would_go);
}

}  // namespace osteomill
