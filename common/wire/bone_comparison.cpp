#include "common/wire/bone_comparison.h"

#include <algorithm>
#include <string>

namespace osteomill {

namespace {

std::uint64_t rounded_up_ratio(std::uint64_t count, std::uint64_t divisor) {
    return count / divisor + (count % divisor != 0 ? 1 : 0);
}

WireError comparison_refused(const std::string& what) {
    return {"comparison refused: " + what};
}

std::optional<WireError> fault_of(const v2::CompareBone& request, std::uint64_t bricks_of_grid) {
    std::uint64_t end_of_last = 0;
    std::size_t parts = 0;
    for (const v2::BrickRange& range : request.ranges()) {
        const std::uint64_t first = range.first_brick();
        if (range.brick_count() == 0 || range.bricks_per_part() == 0)
            return comparison_refused("a range or its parts are empty");
        if (first < end_of_last) return comparison_refused("its ranges overlap or do not ascend");
        if (first >= bricks_of_grid || range.brick_count() > bricks_of_grid - first)
            return comparison_refused("a range of " + std::to_string(range.brick_count()) + " bricks from " +
                                      std::to_string(first) + " on reaches past the grid's " +
                                      std::to_string(bricks_of_grid));
        if (static_cast<std::uint64_t>(range.part_checksum_size()) !=
            rounded_up_ratio(range.brick_count(), range.bricks_per_part()))
            return comparison_refused("a range has more or fewer checksums than parts");
        end_of_last = first + range.brick_count();
        parts += static_cast<std::size_t>(range.part_checksum_size());
    }
    if (parts == 0 || parts > most_parts_of_a_comparison)
        return comparison_refused("it has " + std::to_string(parts) + " parts, not 1 to " +
                                  std::to_string(most_parts_of_a_comparison));
    return std::nullopt;
}

}  // namespace

DifferenceSearch::DifferenceSearch(const Bone& bone) {
    const std::vector<BrickIndex>& bricks = bone.content().brick_of_slot;
    if (!bricks.empty()) suspects_.emplace(bricks.front(), std::uint64_t{bricks.back()} - bricks.front() + 1);
}

std::optional<v2::CompareBone> DifferenceSearch::next(const Bone& bone, const RunningChecksum& checksum) {
    v2::CompareBone request;
    while (!suspects_.empty()) {
        const auto [first, count] = *suspects_.begin();
        const std::size_t parts_left = most_parts_of_a_comparison - requested_.size();
        if (count > parts_left && !requested_.empty()) break;  // finer parts in a request of its own
        suspects_.erase(suspects_.begin());
        const std::uint64_t per_part = rounded_up_ratio(count, most_parts_of_a_comparison);
        v2::BrickRange& range = *request.add_ranges();
        range.set_first_brick(first);
        range.set_brick_count(count);
        range.set_bricks_per_part(per_part);
        for (std::uint64_t done = 0; done < count; done += per_part) {
            requested_.push_back({first + static_cast<BrickIndex>(done), std::min(per_part, count - done)});
            range.add_part_checksum(checksum.sum_of(bone, requested_.back().first, requested_.back().count));
        }
    }
    if (requested_.empty()) return std::nullopt;
    ++requests_;
    return request;
}

std::optional<WireError> DifferenceSearch::take(const v2::Comparison& answer) {
    if (requested_.empty()) return WireError{"an answer came to a comparison that was not asked for"};
    std::int64_t last = -1;
    for (const std::uint32_t part : answer.differing_part()) {
        if (part >= requested_.size() || part <= last)
            return WireError{"a comparison names part " + std::to_string(part) + " of " +
                             std::to_string(requested_.size()) + " after " + std::to_string(last)};
        last = part;
        const Range& range = requested_[part];
        if (range.count == 1)
            ++bricks_found_;
        else
            suspects_.emplace(range.first, range.count);
    }
    requested_.clear();
    return std::nullopt;
}

std::variant<ComparedBone, WireError> compare_bone(const v2::CompareBone& request, const Bone& bone,
                                                   const RunningChecksum& checksum) {
    const glm::uvec3 size(bone.content().size_bricks);
    if (auto fault = fault_of(request, std::uint64_t{size.x} * size.y * size.z)) return *fault;
    ComparedBone compared;
    std::uint32_t part = 0;
    for (const v2::BrickRange& range : request.ranges()) {
        std::uint64_t done = 0;
        for (const std::uint64_t theirs : range.part_checksum()) {
            const BrickIndex first = range.first_brick() + static_cast<BrickIndex>(done);
            const std::uint64_t count = std::min(range.bricks_per_part(), range.brick_count() - done);
            if (checksum.sum_of(bone, first, count) != theirs) {
                compared.answer.add_differing_part(part);
                if (count == 1 && bone.slot(first) != BoneContent::no_slot)
                    compared.differing_bricks.push_back(first);
            }
            ++part;
            done += count;
        }
    }
    return compared;
}

}  // namespace osteomill
