// Estimate of the memory that an import takes, known before it starts.
#pragma once

#include <cstdint>

#include "common/bone/grid.h"

namespace osteomill {

/// An import that would take more is refused.
inline constexpr std::uint64_t most_import_bytes = std::uint64_t{3} << 29;

/// A scan that takes more than this as float, with the shapes of its slices, lies in a scratch file while it
/// is refined.
inline constexpr std::uint64_t most_scan_bytes = std::uint64_t{512} << 20;

/// Slices of the result that are refined at once: as many as bricks are thick, fewer if they are large.
int slices_at_once(const Grid& result);

/// Peak bytes of an import. `reading_bytes`: the memory to read the file; `part_floats`: the region's voxels
/// and the shapes of their slices, which are held until the end.
std::uint64_t import_memory_bytes(std::uint64_t reading_bytes, std::uint64_t part_floats, const Grid& result);

}  // namespace osteomill
