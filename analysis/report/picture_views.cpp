#include "analysis/report/picture_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "common/words/decimal_sign.h"
#include "common/words/translation.h"

namespace osteomill {

namespace {

constexpr double least_half_width_mm = 4.0;

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    bool is_empty() const { return !(low.x <= high.x); }
    void hold(const glm::dvec3& place) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    glm::dvec3 centre() const { return 0.5 * (low + high); }
    double half_width_mm() const {
        return std::max(least_half_width_mm, 1.35 * 0.5 * glm::length(high - low));
    }
};

/// Box of the voxels of stored bricks that `is_wanted(slot, offset)`.
Box box_of(const Bone& bone, auto&& is_wanted) {
    Box box;
    const BoneContent& content = bone.content();
    for (std::int32_t slot = 0; slot < static_cast<std::int32_t>(bone.stored_bricks()); ++slot) {
        const glm::ivec3 first =
            brick_edge_voxels *
            brick_position(content.size_bricks, content.brick_of_slot[static_cast<std::size_t>(slot)]);
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
            if (is_wanted(slot, offset))
                box.hold(centre_of_voxel_mm(bone.grid(), first + voxel_in_brick(offset)));
    }
    return box;
}

Box box_of_plan(const SessionTrace& trace, const PlannedRegion* region) {
    if (region == nullptr) return {};
    return box_of(trace.at_start,
                  [&](auto slot, auto offset) { return region->voxels().contains(slot, offset); });
}

Box box_of_work(const SessionTrace& trace, const PlannedRegion* region) {
    Box box = box_of_plan(trace, region);
    const Box removed = box_of(trace.at_start, [&](auto slot, auto offset) {
        return trace.at_start.fractions(slot)[offset] != trace.at_end.fractions(slot)[offset];
    });
    for (const Box& part : {box, removed})
        if (!part.is_empty()) box.hold(part.low), box.hold(part.high);
    if (!box.is_empty()) return box;
    return box_of(trace.at_start,
                  [](auto, std::size_t offset) { return offset == 0 || offset == brick_voxel_count - 1; });
}

/// The spindle's direction when bone first went; else as the session began.
glm::dvec3 handpiece_axis(const SessionTrace& trace) {
    glm::dvec3 axis(0.0, 0.0, 1.0);
    const auto cutting = std::ranges::find_if(trace.samples, &TraceSample::cuts);
    if (cutting != trace.samples.end())
        axis = cutting->spindle_axis;
    else if (!trace.samples.empty())
        axis = trace.samples.front().spindle_axis;
    const double length = glm::length(axis);
    return length > 1e-6 ? axis / length : glm::dvec3(0.0, 0.0, 1.0);
}

glm::dvec3 square_to(const glm::dvec3& direction) {
    const glm::dvec3 wanted = std::abs(direction.z) > 0.7 ? glm::dvec3(0, -1.0, 0) : glm::dvec3(0, 0, 1.0);
    return glm::normalize(wanted - glm::dot(wanted, direction) * direction);
}

/// As radiologists see them: the patient's right at the picture's left.
NamedView section_from_front(const glm::dvec3& centre_mm, double half_width_mm) {
    return {tr("section, from the front"), {centre_mm, {0, 1.0, 0}, {0, 0, 1.0}, half_width_mm, true}};
}

NamedView section_from_left(const glm::dvec3& centre_mm, double half_width_mm) {
    return {tr("section, from the left"), {centre_mm, {-1.0, 0, 0}, {0, 0, 1.0}, half_width_mm, true}};
}

NamedView section_from_below(const glm::dvec3& centre_mm, double half_width_mm) {
    return {tr("section, from below"), {centre_mm, {0, 0, 1.0}, {0, -1.0, 0}, half_width_mm, true}};
}

/// The anatomical section whose plane is closest to the direction.
NamedView section_along(const glm::dvec3& direction, const glm::dvec3& centre_mm, double half_width_mm) {
    const glm::dvec3 size = glm::abs(direction);
    if (size.y <= size.x && size.y <= size.z) return section_from_front(centre_mm, half_width_mm);
    if (size.x <= size.z) return section_from_left(centre_mm, half_width_mm);
    return section_from_below(centre_mm, half_width_mm);
}

glm::dvec3 nearest_voxel_mm(const StructureMask& mask, const glm::dvec3& from_mm) {
    glm::dvec3 nearest = from_mm;
    double least_mm = std::numeric_limits<double>::infinity();
    const glm::ivec3 size_bricks = size_in_bricks(mask.grid());
    for (const StructureBrick& brick : mask.bricks()) {
        const glm::ivec3 first = brick_edge_voxels * brick_position(size_bricks, brick.brick);
        brick.voxels.for_each([&](std::size_t offset) {
            const glm::dvec3 place = centre_of_voxel_mm(mask.grid(), first + voxel_in_brick(offset));
            if (const double mm = glm::length(place - from_mm); mm < least_mm) least_mm = mm, nearest = place;
        });
    }
    return nearest;
}

}  // namespace

std::vector<NamedView> views_of_work(const SessionTrace& trace, const PlannedRegion* region) {
    const Box box = box_of_work(trace, region);
    if (box.is_empty()) return {};
    const glm::dvec3 centre = box.centre();
    const glm::dvec3 axis = handpiece_axis(trace);
    return {{tr("from the handpiece"), {centre, -axis, square_to(-axis), box.half_width_mm(), false}},
            section_from_front(centre, box.half_width_mm()),
            section_from_left(centre, box.half_width_mm())};
}

std::optional<NearestApproach> nearest_approach(const SessionTrace& trace) {
    NearestApproach nearest;
    std::size_t tissue = 0;
    for (const TraceSample& sample : trace.samples)
        for (const StructureDistance& one : sample.distances)
            if (one.distance_mm && (nearest.sample == nullptr || *one.distance_mm < nearest.distance_mm)) {
                nearest.sample = &sample;
                nearest.distance_mm = *one.distance_mm;
                tissue = one.tissue;
            }
    const auto structure = std::ranges::find(trace.structure_places, tissue, &Structure::tissue);
    if (nearest.sample == nullptr || structure == trace.structure_places.end()) return std::nullopt;
    nearest.structure = trace.session.tissues[tissue].name;
    nearest.structure_mm = nearest_voxel_mm(structure->mask, nearest.sample->burr_mm);
    nearest.distance_mm = std::max(0.0, nearest.distance_mm);
    return nearest;
}

std::optional<NamedView> view_of_target(const SessionTrace& trace, const PlannedRegion* region) {
    Box box = box_of_plan(trace, region);
    if (box.is_empty()) box = box_of_work(trace, region);
    if (box.is_empty()) return std::nullopt;
    NamedView target = section_along(handpiece_axis(trace), box.centre(), box.half_width_mm());
    target.title = region != nullptr ? trf("Through the target, {}", target.title)
                                     : trf("Through the work, {}", target.title);
    return target;
}

NamedView view_of(const NearestApproach& approach, double burr_diameter_mm) {
    const glm::dvec3 apart = approach.structure_mm - approach.sample->burr_mm;
    const double half_width_mm =
        std::max(least_half_width_mm, 1.5 * (glm::length(apart) + 0.5 * burr_diameter_mm));
    NamedView view = section_along(apart, approach.sample->burr_mm, half_width_mm);
    const std::string structure = tissue_words(approach.structure);
    const std::string time_s = with_decimal_sign(fmt::format("{:.1f}", approach.sample->time_s));
    view.title = approach.distance_mm > 0.0
                     ? trf("{} mm from the {}, at {} s, {}",
                           with_decimal_sign(fmt::format("{:.2f}", approach.distance_mm)), structure, time_s,
                           view.title)
                     : trf("Touch of the {}, at {} s, {}", structure, time_s, view.title);
    return view;
}

}  // namespace osteomill
