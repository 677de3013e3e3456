#include "simulation/force_models/ball_rows.h"

#include <glm/geometric.hpp>

#include "simulation/force_models/bone_surface.h"

namespace osteomill {

bool has_bone_in(const Bone& bone, const Ball& ball) noexcept {
    bool is_inside = false;
    visit_rows(bone, ball, [&](const BallRow& row) {
        const auto fractions = bone.fractions(row.slot).subspan(row.row_offset, brick_edge_voxels);
        glm::dvec3 from_centre = glm::dvec3(row.first) - ball.centre;
        for (int i = 0; i < row.count; ++i, from_centre.x += 1.0) {
            is_inside = is_inside ||
                        (fractions[static_cast<std::size_t>((row.first.x & 15) + i)] >= surface_fraction &&
                         cover_of(ball, glm::dot(from_centre, from_centre)) >= 1.0);
        }
    });
    return is_inside;
}

}  // namespace osteomill
