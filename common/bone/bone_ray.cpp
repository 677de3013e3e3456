#include "common/bone/bone_ray.h"

#include <cmath>
#include <limits>

namespace osteomill {

RaySpan span_within(const BoneRay& ray, const glm::dvec3& low, const glm::dvec3& high) {
    RaySpan span{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (int axis = 0; axis < 3; ++axis) {
        const double slope = ray.direction[axis];
        if (std::abs(slope) < 1e-12) {
            if (ray.origin[axis] < low[axis] || ray.origin[axis] > high[axis]) return {1.0, 0.0};
            continue;
        }
        const double a = (low[axis] - ray.origin[axis]) / slope;
        const double b = (high[axis] - ray.origin[axis]) / slope;
        span.from = std::max(span.from, std::min(a, b));
        span.to = std::min(span.to, std::max(a, b));
    }
    return span;
}

RaySpan span_within(const BoneRay& ray, const Grid& grid) {
    return span_within(ray, glm::dvec3(-0.5), glm::dvec3(grid.size_voxels) - 0.5);
}

bool BoneSampler::has_bone(const glm::ivec3& brick) {
    if (brick != brick_) {
        brick_ = brick;
        slot_ = bone_.slot(brick);
    }
    return slot_ != BoneContent::no_slot;
}

double BoneSampler::at(const glm::ivec3& voxel) {
    if (!contains(bone_.grid(), voxel) || !has_bone(voxel / brick_edge_voxels)) return 0.0;
    return bone_.fractions(slot_)[offset_in_brick(voxel)];
}

double BoneSampler::between(const glm::dvec3& place) {
    const glm::dvec3 low = glm::floor(place);
    const glm::dvec3 part = place - low;
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::dvec3 share(step.x == 1 ? part.x : 1.0 - part.x, step.y == 1 ? part.y : 1.0 - part.y,
                               step.z == 1 ? part.z : 1.0 - part.z);
        sum += share.x * share.y * share.z * at(glm::ivec3(low) + step);
    }
    return sum;
}

}  // namespace osteomill
