// How much memory an import will take, told before it starts.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>

#include "common/bone/grid.h"

namespace osteomill {

/// Peak bytes of an import: the larger of reading (the file's own voxels beside their copy as float), cutting
/// out the region, and refining (smoothed copies, spline coefficients and the result).
std::uint64_t import_memory_bytes(std::uint64_t source_voxels, std::uint64_t region_source_voxels,
                                  const Grid& result);

/// MemAvailable of /proc/meminfo, in bytes; std::nullopt where the text has none.
std::optional<std::uint64_t> available_memory_bytes(std::istream& meminfo);

}  // namespace osteomill
