#include "haptic_server/streaming/stroke_journal.h"

#include <zstd.h>

#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace osteomill {

void StrokeJournal::note(const BrickChange& change, const Bone& bone) {
    const std::int32_t slot = bone.slot(change.brick);
    if (change.kind == ChangeKind::restored || slot == BoneContent::no_slot) return;
    undone_.clear();
    const auto [found, is_new] = open_.try_emplace(change.brick);
    Restored& before = found->second;
    if (is_new) {
        before.change = {change.brick, {}, ChangeKind::restored};
        before.fractions.fill(0);
    }
    const VoxelMask first_touched = change.voxels.without(before.change.voxels);
    const BrickFractions now = std::as_const(bone).fractions(slot);
    first_touched.for_each([&](std::size_t voxel) { before.fractions[voxel] = now[voxel]; });
    before.change.voxels |= first_touched;
}

void StrokeJournal::end_stroke() {
    if (open_.empty()) return;
    std::vector<Restored> bricks;
    for (auto& [brick, before] : open_) bricks.push_back(before);
    open_.clear();
    done_.push_back(pack(bricks));
}

std::int64_t StrokeJournal::undo(const Bone& bone, Restoration& restoration) {
    return move(done_, undone_, bone, restoration);
}

std::int64_t StrokeJournal::redo(const Bone& bone, Restoration& restoration) {
    return move(undone_, done_, bone, restoration);
}

std::size_t StrokeJournal::memory_bytes() const {
    std::size_t bytes = 0;
    for (const auto* strokes : {&done_, &undone_})
        for (const Stroke& stroke : *strokes) bytes += sizeof stroke + stroke.packed.size();
    return bytes;
}

std::int64_t StrokeJournal::move(std::vector<Stroke>& from, std::vector<Stroke>& to, const Bone& bone,
                                 Restoration& restoration) {
    if (from.empty() || has_open_stroke())
        throw std::logic_error("there is no stroke to restore, or one is under way");
    std::vector<Restored> stroke = unpack(from.back());
    from.pop_back();
    std::int64_t levels = 0;
    for (Restored& brick : stroke) {
        const auto [found, is_new] = restoration.try_emplace(brick.change.brick);
        Restored& all = found->second;
        if (is_new) {
            all.change = {brick.change.brick, {}, ChangeKind::restored};
            all.fractions.fill(0);
        }
        const BrickFractions now = std::as_const(bone).fractions(bone.slot(brick.change.brick));
        const VoxelMask only_in_bone = brick.change.voxels.without(all.change.voxels);
        only_in_bone.for_each([&](std::size_t voxel) { all.fractions[voxel] = now[voxel]; });
        all.change.voxels |= only_in_bone;
        brick.change.voxels.for_each([&](std::size_t voxel) {
            levels += int{brick.fractions[voxel]} - int{all.fractions[voxel]};
            std::swap(brick.fractions[voxel], all.fractions[voxel]);
        });
    }
    to.push_back(pack(stroke));
    return levels;
}

StrokeJournal::Stroke StrokeJournal::pack(const std::vector<Restored>& bricks) {
    static_assert(std::is_trivially_copyable_v<Restored>);
    // Fractions outside the mask are 0, so they cost next to nothing.
    const auto packed = compressor_.compress(
        {reinterpret_cast<const std::uint8_t*>(bricks.data()), bricks.size() * sizeof(Restored)});
    return {.bricks = bricks.size(), .packed = {packed.begin(), packed.end()}};
}

std::vector<StrokeJournal::Restored> StrokeJournal::unpack(const Stroke& stroke) {
    std::vector<Restored> bricks(stroke.bricks);
    const std::size_t bytes = bricks.size() * sizeof(Restored);
    if (ZSTD_decompress(bricks.data(), bytes, stroke.packed.data(), stroke.packed.size()) != bytes)
        throw std::logic_error("a stroke in memory cannot be unpacked");
    return bricks;
}

}  // namespace osteomill
