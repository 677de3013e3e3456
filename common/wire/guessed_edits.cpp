#include "common/wire/guessed_edits.h"

#include <zstd.h>

#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/wire/brick_edit.h"

namespace osteomill {

namespace {

/// Some ten microseconds more than the fastest for a frame, and a tenth smaller.
constexpr int frame_compression_level = 3;

WireError edits_refused(const std::string& what) {
    return {"guessed edits refused: " + what};
}

void append(const VoxelMask& mask, std::vector<std::uint8_t>& bytes) {
    const std::size_t begin = bytes.size();
    bytes.resize(begin + mask_bytes);
    for (std::size_t voxel = mask._Find_first(); voxel < brick_voxel_count; voxel = mask._Find_next(voxel))
        bytes[begin + voxel / 8] = static_cast<std::uint8_t>(bytes[begin + voxel / 8] | 1U << voxel % 8);
}

VoxelMask mask_at(std::span<const std::uint8_t> bytes) {
    VoxelMask mask;
    for (std::size_t n = 0; n < mask_bytes; ++n)
        for (std::size_t k = 0; bytes[n] >> k != 0; ++k)
            if (bytes[n] >> k & 1) mask.set(8 * n + k);
    return mask;
}

BrickGuess guess(const std::optional<GuessedSweep>& sweep, const glm::ivec3& size_bricks, BrickIndex brick) {
    return sweep ? guess_brick(*sweep, brick_position(size_bricks, brick)) : BrickGuess{};
}

}  // namespace

void GuessedEditsPacker::Free::operator()(ZSTD_CCtx_s* context) const {
    ZSTD_freeCCtx(context);
}

GuessedEditsPacker::GuessedEditsPacker()
    : context_(ZSTD_createCCtx()), compressed_(ZSTD_compressBound(largest_guessed_edits_bytes)) {
    if (!context_) throw std::bad_alloc();
    differences_.reserve(largest_guessed_edits_bytes);
}

v1::GuessedEdits GuessedEditsPacker::pack(const Bone& bone, const std::vector<ChangedBrick>& bricks,
                                          const std::optional<GuessedSweep>& sweep) {
    v1::GuessedEdits message;
    if (sweep) *message.mutable_sweep() = to_message(*sweep);
    std::vector<ByteBrick> guessed;
    guessed.reserve(bricks.size());
    differences_.clear();
    for (const ChangedBrick& changed : bricks) {
        const BrickGuess by_sweep = guess(sweep, bone.content().size_bricks, changed.brick);
        message.add_brick(changed.brick);
        append(changed.voxels ^ by_sweep.changed, differences_);
        guessed.push_back(by_sweep.left);
    }
    for (std::size_t i = 0; i < bricks.size(); ++i) {
        const auto fractions = bone.fractions(bone.slot(bricks[i].brick));
        const VoxelMask& mask = bricks[i].voxels;
        for (std::size_t voxel = mask._Find_first(); voxel < brick_voxel_count;
             voxel = mask._Find_next(voxel))
            differences_.push_back(static_cast<std::uint8_t>(fractions[voxel] - guessed[i][voxel]));
    }
    const std::size_t size =
        ZSTD_compressCCtx(context_.get(), compressed_.data(), compressed_.size(), differences_.data(),
                          differences_.size(), frame_compression_level);
    if (ZSTD_isError(size)) throw std::runtime_error(ZSTD_getErrorName(size));
    message.set_zstd_differences(compressed_.data(), size);
    return message;
}

std::variant<std::vector<v1::BrickEdit>, WireError> unpack(const v1::GuessedEdits& message,
                                                           const glm::ivec3& size_bricks) {
    std::optional<GuessedSweep> sweep;
    if (message.has_sweep()) {
        auto read = guessed_sweep_from(message.sweep());
        if (auto* error = std::get_if<WireError>(&read)) return std::move(*error);
        sweep = std::get<GuessedSweep>(read);
    }
    const auto count = static_cast<std::size_t>(message.brick_size());
    if (count == 0 || count * mask_bytes > largest_guessed_edits_bytes)
        return edits_refused("they are of " + std::to_string(count) + " bricks, not 1 to " +
                             std::to_string(largest_guessed_edits_bytes / mask_bytes));
    std::vector<std::uint8_t> differences(largest_guessed_edits_bytes);
    const std::size_t size =
        ZSTD_decompress(differences.data(), differences.size(), message.zstd_differences().data(),
                        message.zstd_differences().size());
    if (ZSTD_isError(size)) return edits_refused(ZSTD_getErrorName(size));
    if (size < count * mask_bytes) return edits_refused("they lack masks");
    differences.resize(size);

    const glm::uvec3 table(size_bricks);
    std::vector<v1::BrickEdit> edits;
    edits.reserve(count);
    std::size_t next = count * mask_bytes;
    for (std::size_t i = 0; i < count; ++i) {
        const BrickIndex brick = message.brick(static_cast<int>(i));
        if (brick >= std::uint64_t{table.x} * table.y * table.z)
            return edits_refused("brick " + std::to_string(brick) + " lies outside the grid");
        const BrickGuess by_sweep = guess(sweep, size_bricks, brick);
        const VoxelMask changed = by_sweep.changed ^ mask_at(std::span(differences).subspan(i * mask_bytes));
        if (changed.count() > size - next) return edits_refused("they lack fractions");
        ByteBrick fractions = by_sweep.left;
        for (std::size_t voxel = changed._Find_first(); voxel < brick_voxel_count;
             voxel = changed._Find_next(voxel))
            fractions[voxel] = static_cast<std::uint8_t>(fractions[voxel] + differences[next++]);
        edits.push_back(brick_edit(brick, fractions, changed));
    }
    if (next != size) return edits_refused("they have more fractions than changed voxels");
    return edits;
}

}  // namespace osteomill
