#include "analysis/report/voxel_set.h"

#include <algorithm>
#include <array>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <vector>

namespace osteomill {

bool VoxelSet::contains(const glm::ivec3& voxel) const {
    if (!osteomill::contains(bone_->grid(), voxel)) return false;
    const std::int32_t slot = bone_->slot(voxel / brick_edge_voxels);
    return slot != BoneContent::no_slot && contains(slot, offset_in_brick(voxel));
}

std::size_t VoxelSet::count() const {
    std::size_t sum = 0;
    for (const VoxelMask& mask : by_slot_) sum += mask.count();
    return sum;
}

template <typename IsOutside>
std::vector<glm::dvec3> VoxelSet::beside_mm(const IsOutside& is_outside) const {
    static constexpr std::array<glm::ivec3, 6> steps{glm::ivec3(1, 0, 0), glm::ivec3(-1, 0, 0),
                                                     glm::ivec3(0, 1, 0), glm::ivec3(0, -1, 0),
                                                     glm::ivec3(0, 0, 1), glm::ivec3(0, 0, -1)};
    std::vector<glm::dvec3> places;
    for_each([&](std::int32_t, std::size_t, const glm::ivec3& voxel) {
        for (const glm::ivec3& step : steps)
            if (is_outside(voxel + step)) {
                places.push_back(centre_of_voxel_mm(bone_->grid(), voxel));
                return;
            }
    });
    return places;
}

std::vector<glm::dvec3> VoxelSet::boundary_mm() const {
    return beside_mm([&](const glm::ivec3& voxel) {
        return osteomill::contains(bone_->grid(), voxel) && bone_->fraction_at(voxel) >= half_a_voxel &&
               !contains(voxel);
    });
}

std::vector<glm::dvec3> VoxelSet::surface_mm() const {
    return beside_mm([&](const glm::ivec3& voxel) { return !contains(voxel); });
}

VoxelSet cavity_of(const Bone& bone, const Bone& carved) {
    VoxelSet cavity(bone);
    for (std::int32_t slot = 0; slot < static_cast<std::int32_t>(bone.stored_bricks()); ++slot) {
        const BrickFractions before = bone.fractions(slot);
        const BrickFractions after = carved.fractions(slot);
        if (std::ranges::equal(before, after)) continue;
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
            if (before[offset] >= half_a_voxel && int{before[offset]} - int{after[offset]} >= half_a_voxel)
                cavity.set(slot, offset);
    }
    return cavity;
}

namespace {

namespace geometry = boost::geometry;
using Point = geometry::model::point<double, 3, geometry::cs::cartesian>;

Point point(const glm::dvec3& place) {
    return {place.x, place.y, place.z};
}

std::vector<Point> points(std::span<const glm::dvec3> places) {
    std::vector<Point> all;
    all.reserve(places.size());
    for (const glm::dvec3& place : places) all.push_back(point(place));
    return all;
}

}  // namespace

struct NearestPlace::Tree {
    geometry::index::rtree<Point, geometry::index::linear<16>> points;
};

NearestPlace::NearestPlace(std::span<const glm::dvec3> places_mm)
    : tree_(std::make_unique<Tree>(Tree{decltype(Tree::points)(points(places_mm))})) {}
NearestPlace::~NearestPlace() = default;
NearestPlace::NearestPlace(NearestPlace&&) noexcept = default;
NearestPlace& NearestPlace::operator=(NearestPlace&&) noexcept = default;

std::optional<glm::dvec3> NearestPlace::nearest_mm(const glm::dvec3& from_mm) const {
    const auto found = tree_->points.qbegin(geometry::index::nearest(point(from_mm), 1));
    if (found == tree_->points.qend()) return std::nullopt;
    return glm::dvec3(found->get<0>(), found->get<1>(), found->get<2>());
}

std::optional<double> NearestPlace::distance_mm(const glm::dvec3& from_mm) const {
    const auto nearest = nearest_mm(from_mm);
    return nearest ? std::optional(geometry::distance(point(from_mm), point(*nearest))) : std::nullopt;
}

}  // namespace osteomill
