#include "common/wire/ct_pieces.h"

#include <zstd.h>

#include <algorithm>
#include <string>
#include <utility>

#include "common/wire/geometry_messages.h"

namespace osteomill {

namespace {

/// 64 kB: fits a frame even if nothing compresses.
constexpr std::size_t voxels_per_piece = 32 * 1024;

WireError ct_refused(const std::string& what) {
    return {"CT refused: " + what};
}

std::size_t count_of(const Grid& grid) {
    return static_cast<std::size_t>(grid.size_voxels.x) * static_cast<std::size_t>(grid.size_voxels.y) *
           static_cast<std::size_t>(grid.size_voxels.z);
}

}  // namespace

v2::CtPiece CtPacker::pack(const CtVolume& ct, std::size_t& first_voxel) {
    v2::CtPiece piece;
    if (first_voxel == 0) *piece.mutable_grid() = to_message(ct.grid);
    piece.set_first_voxel(first_voxel);
    const std::size_t count = std::min(voxels_per_piece, ct.hu.size() - first_voxel);
    // The differences of neighbouring voxels, two bytes each, compress to half the size of the values
    // themselves.
    std::vector<std::uint8_t> bytes(2 * count);
    std::int16_t before = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::int16_t hu = ct.hu[first_voxel + i];
        const auto difference = static_cast<std::uint16_t>(hu - std::exchange(before, hu));
        bytes[i] = static_cast<std::uint8_t>(difference & 0xFFU);
        bytes[count + i] = static_cast<std::uint8_t>(difference >> 8U);
    }
    const auto packed = compressor_.compress(bytes);
    piece.set_zstd_hu(packed.data(), packed.size());
    first_voxel += count;
    return piece;
}

std::variant<std::shared_ptr<const CtVolume>, WireError> CtAssembler::take(const v2::CtPiece& piece) {
    const auto refuse = [this](const std::string& what) {
        ct_.reset();
        return ct_refused(what);
    };
    if (piece.has_grid()) {
        auto grid = grid_from(piece.grid());
        if (auto* error = std::get_if<WireError>(&grid)) return refuse(error->line);
        if (count_of(std::get<Grid>(grid)) > most_ct_voxels)
            return refuse("it has more than " + std::to_string(most_ct_voxels) + " voxels");
        ct_ = std::make_shared<CtVolume>(CtVolume{std::get<Grid>(grid), {}});
        ct_->hu.resize(count_of(ct_->grid));
        next_voxel_ = 0;
    }
    if (!ct_) return refuse("a piece came without the first");
    if (piece.first_voxel() != next_voxel_) return refuse("a piece came out of order");
    const std::size_t count = std::min(voxels_per_piece, ct_->hu.size() - next_voxel_);
    std::vector<std::uint8_t> bytes(2 * count);
    const std::size_t size =
        ZSTD_decompress(bytes.data(), bytes.size(), piece.zstd_hu().data(), piece.zstd_hu().size());
    if (ZSTD_isError(size) || size != bytes.size()) return refuse("a piece cannot be unpacked");
    std::uint16_t hu = 0;
    for (std::size_t i = 0; i < count; ++i) {
        hu = static_cast<std::uint16_t>(hu + bytes[i] + (bytes[count + i] << 8U));
        ct_->hu[next_voxel_ + i] = static_cast<std::int16_t>(hu);
    }
    next_voxel_ += count;
    if (next_voxel_ < ct_->hu.size()) return std::shared_ptr<const CtVolume>();
    return std::shared_ptr<const CtVolume>(std::exchange(ct_, nullptr));
}

}  // namespace osteomill
