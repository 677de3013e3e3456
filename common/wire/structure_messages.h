// Protected structures, in and out of messages.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "common/bone/structure_mask.h"
#include "common/scene/scene.h"
#include "common/wire/frame.h"

namespace osteomill::v2 {
class StructureBricks;  // of session.pb.h, which takes long to parse
}

namespace osteomill {

/// In one message; even if nothing compresses it fits a frame.
inline constexpr std::size_t most_bricks_of_structure_piece = 128;
/// The most bricks of all structures together: 128 MiB of masks, 1 dm^3 at 0.1 mm. A mask's size on the wire
/// bounds nothing.
inline constexpr std::size_t most_structure_bricks = std::size_t{1} << 18U;

/// All messages of these structures. Throws std::invalid_argument for more bricks than are sent.
std::vector<v2::StructureBricks> structure_pieces(std::span<const Structure> structures);

/// Puts the structures of one session together from their messages.
class StructureAssembler {
  public:
    StructureAssembler() = default;
    /// For structures of these tissues, on the grid of the bone.
    StructureAssembler(const std::vector<Tissue>& tissues, const Grid& grid);

    /// The structure when its last piece has come, else nothing. A piece of one that is complete changes
    /// nothing: a recording may be wound back. Refuses a piece that makes no sense, and then forgets that
    /// structure's earlier pieces.
    std::variant<std::optional<Structure>, WireError> take(const v2::StructureBricks& piece);
    /// Some pieces will not come: forgets the structure that is not complete.
    void miss();

  private:
    std::optional<WireError> add(const v2::StructureBricks& piece);

    std::vector<bool> awaited_;  // by tissue: protected, and not complete
    std::vector<bool> complete_;
    Grid grid_{};
    std::uint64_t grid_bricks_ = 0;
    std::optional<std::size_t> under_way_;
    std::vector<StructureBrick> bricks_;  // the incoming structure's
    std::size_t taken_bricks_ = 0;        // the complete structures'
};

}  // namespace osteomill
