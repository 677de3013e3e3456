#include "common/wire/structure_messages.h"

#include <zstd.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/wire/packed_changes.h"
#include "common/wire/zstd_compressor.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

namespace {

/// Masks shrink to a tenth, and are packed once.
constexpr int structure_compression_level = 9;

WireError structure_refused(const std::string& what) {
    return {"structure refused: " + what};
}

}  // namespace

std::vector<v2::StructureBricks> structure_pieces(std::span<const Structure> structures) {
    std::vector<v2::StructureBricks> pieces;
    std::size_t all_bricks = 0;
    for (const Structure& structure : structures) all_bricks += structure.mask.bricks().size();
    if (all_bricks > most_structure_bricks)
        throw std::invalid_argument("the protected structures have " + std::to_string(all_bricks) +
                                    " bricks of voxels, more than the " +
                                    std::to_string(most_structure_bricks) +
                                    " that are sent; crop or coarsen the bone");
    ZstdCompressor compressor(structure_compression_level);
    std::vector<std::uint8_t> masks;
    for (const Structure& structure : structures) {
        const auto& bricks = structure.mask.bricks();
        for (std::size_t first = 0; first < bricks.size(); first += most_bricks_of_structure_piece) {
            const std::size_t end = std::min(bricks.size(), first + most_bricks_of_structure_piece);
            v2::StructureBricks& piece = pieces.emplace_back();
            piece.set_tissue(static_cast<std::uint32_t>(structure.tissue));
            piece.set_is_last(end == bricks.size());
            masks.clear();
            for (std::size_t i = first; i < end; ++i) {
                piece.add_brick(bricks[i].brick);
                append(bricks[i].voxels, masks);
            }
            const auto packed = compressor.compress(masks);
            piece.set_zstd_masks(packed.data(), packed.size());
        }
    }
    return pieces;
}

StructureAssembler::StructureAssembler(const std::vector<Tissue>& tissues, const Grid& grid)
    : complete_(tissues.size(), false), grid_(grid) {
    for (const Tissue& tissue : tissues) awaited_.push_back(tissue.is_protected);
    const glm::uvec3 size(size_in_bricks(grid));
    grid_bricks_ = std::uint64_t{size.x} * size.y * size.z;
}

std::variant<std::optional<Structure>, WireError> StructureAssembler::take(const v2::StructureBricks& piece) {
    const std::size_t tissue = piece.tissue();
    if (tissue >= complete_.size())
        return structure_refused("tissue " + std::to_string(tissue) + " is not one of the scene's " +
                                 std::to_string(complete_.size()));
    if (complete_[tissue]) return std::nullopt;
    if (!awaited_[tissue]) return structure_refused("tissue " + std::to_string(tissue) + " is not protected");
    if (under_way_ && *under_way_ != tissue) {
        miss();
        return structure_refused("another began before it was complete");
    }
    under_way_ = tissue;
    if (auto error = add(piece)) {
        miss();
        return *std::move(error);
    }
    if (!piece.is_last()) return std::nullopt;
    try {
        Structure structure{tissue, StructureMask(grid_, std::exchange(bricks_, {}))};
        taken_bricks_ += structure.mask.bricks().size();
        complete_[tissue] = true;
        under_way_.reset();
        return structure;
    } catch (const std::invalid_argument& error) {
        miss();
        return structure_refused(error.what());
    }
}

void StructureAssembler::miss() {
    under_way_.reset();
    bricks_.clear();
}

std::optional<WireError> StructureAssembler::add(const v2::StructureBricks& piece) {
    const auto count = static_cast<std::size_t>(piece.brick_size());
    if (count == 0 || count > most_bricks_of_structure_piece)
        return structure_refused("a piece holds " + std::to_string(count) + " bricks, not 1 to " +
                                 std::to_string(most_bricks_of_structure_piece));
    if (taken_bricks_ + bricks_.size() + count > most_structure_bricks)
        return structure_refused("there are more than " + std::to_string(most_structure_bricks) + " bricks");
    std::vector<std::uint8_t> masks(count * mask_bytes);
    const std::size_t size =
        ZSTD_decompress(masks.data(), masks.size(), piece.zstd_masks().data(), piece.zstd_masks().size());
    if (ZSTD_isError(size) || size != masks.size()) return structure_refused("a piece cannot be unpacked");
    for (std::size_t i = 0; i < count; ++i) {
        const BrickIndex brick = piece.brick(static_cast<int>(i));
        if (!bricks_.empty() && brick <= bricks_.back().brick)
            return structure_refused("brick " + std::to_string(brick) + " comes after " +
                                     std::to_string(bricks_.back().brick));
        if (brick >= grid_bricks_)
            return structure_refused("brick " + std::to_string(brick) + " lies outside the grid");
        const VoxelMask voxels = mask_at(std::span(masks).subspan(i * mask_bytes));
        if (voxels.none()) return structure_refused("brick " + std::to_string(brick) + " has no voxel");
        bricks_.push_back({brick, voxels});
    }
    return std::nullopt;
}

}  // namespace osteomill
