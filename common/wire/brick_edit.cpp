#include "common/wire/brick_edit.h"

#include <string>

namespace osteomill {

namespace {

WireError edit_refused(BrickIndex brick, const std::string& what) {
    return {"edit of brick " + std::to_string(brick) + " refused: " + what};
}

std::optional<WireError> fault_of_runs(const v1::BrickEdit& edit, const Bone& bone) {
    const BrickIndex brick = edit.brick();
    if (bone.slot(brick) == BoneContent::no_slot) return edit_refused(brick, "no bone is stored there");
    if (edit.changed_size() % 2 != 0) return edit_refused(brick, "a run lacks its length");
    std::size_t taken = 0;
    std::size_t end_of_last = 0;
    for (int i = 0; i < edit.changed_size(); i += 2) {
        const std::size_t first = edit.changed(i);
        const std::size_t length = edit.changed(i + 1);
        if (length == 0 || first < end_of_last)
            return edit_refused(brick, "its runs are empty or do not ascend");
        if (first + length > brick_voxel_count)
            return edit_refused(brick, "a run ends at voxel " + std::to_string(first + length) + " of " +
                                           std::to_string(brick_voxel_count));
        if (length > edit.fraction().size() - taken) return edit_refused(brick, "it has too few fractions");
        taken += length;
        end_of_last = first + length;
    }
    if (taken != edit.fraction().size()) return edit_refused(brick, "it has more fractions than its runs");
    return std::nullopt;
}

/// Calls `use` with each voxel of an edit without fault, and its new fraction, until that says stop.
template <typename Use>
void for_each_voxel_until(const v1::BrickEdit& edit, Use&& use) {
    std::size_t next = 0;
    for (int i = 0; i < edit.changed_size(); i += 2)
        for (std::size_t voxel = edit.changed(i); voxel < edit.changed(i) + edit.changed(i + 1); ++voxel)
            if (use(voxel, static_cast<std::uint8_t>(edit.fraction()[next++]))) return;
}

std::optional<std::size_t> first_raised(const v1::BrickEdit& edit, const Bone& bone) {
    const auto fractions = bone.fractions(bone.slot(edit.brick()));
    std::optional<std::size_t> raised;
    for_each_voxel_until(edit, [&](std::size_t voxel, std::uint8_t fraction) {
        if (fraction > fractions[voxel]) raised = voxel;
        return raised.has_value();
    });
    return raised;
}

/// Bone in a voxel of a brick at the grid's edge that the grid no longer has.
std::optional<std::size_t> first_outside_grid(const v1::BrickEdit& edit, const Bone& bone) {
    const BoneContent& content = bone.content();
    const glm::ivec3 first = brick_edge_voxels * brick_position(content.size_bricks, edit.brick());
    if (contains(content.grid, first + (brick_edge_voxels - 1))) return std::nullopt;
    std::optional<std::size_t> outside;
    for_each_voxel_until(edit, [&](std::size_t voxel, std::uint8_t fraction) {
        if (fraction > 0 && !contains(content.grid, first + voxel_in_brick(voxel))) outside = voxel;
        return outside.has_value();
    });
    return outside;
}

void write(const v1::BrickEdit& edit, Bone& bone) {
    const auto fractions = bone.fractions(bone.slot(edit.brick()));
    for_each_voxel_until(edit, [&](std::size_t voxel, std::uint8_t fraction) {
        fractions[voxel] = fraction;
        return false;
    });
}

}  // namespace

v1::BrickEdit brick_edit(const BrickChange& change, BrickFractions fractions) {
    v1::BrickEdit edit;
    edit.set_brick(change.brick);
    edit.mutable_fraction()->reserve(change.voxels.count());
    std::size_t end_of_last = brick_voxel_count;
    change.voxels.for_each([&](std::size_t voxel) {
        edit.mutable_fraction()->push_back(static_cast<char>(fractions[voxel]));
        if (voxel != end_of_last) {
            edit.add_changed(static_cast<std::uint32_t>(voxel));
            edit.add_changed(0);
        }
        const int length = edit.changed_size() - 1;
        edit.set_changed(length, edit.changed(length) + 1);
        end_of_last = voxel + 1;
    });
    return edit;
}

std::optional<WireError> apply_brick_edit(const v1::BrickEdit& edit, Bone& bone) {
    if (auto fault = fault_of_runs(edit, bone)) return fault;
    if (const auto voxel = first_raised(edit, bone))
        return edit_refused(edit.brick(), "it raises what is left of voxel " + std::to_string(*voxel));
    write(edit, bone);
    return std::nullopt;
}

std::variant<EditEffect, WireError> correct_with_brick_edit(const v1::BrickEdit& edit, Bone& bone) {
    if (auto fault = fault_of_runs(edit, bone)) return *fault;
    if (const auto voxel = first_outside_grid(edit, bone))
        return edit_refused(edit.brick(), "its voxel " + std::to_string(*voxel) + " lies outside the grid");
    const EditEffect effect = first_raised(edit, bone) ? EditEffect::raises : EditEffect::lowers;
    write(edit, bone);
    return effect;
}

}  // namespace osteomill
