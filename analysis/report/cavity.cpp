#include "analysis/report/cavity.h"

#include <algorithm>

namespace osteomill {

VoxelSet cavity_of(const SessionTrace& trace) {
    VoxelSet cavity(trace.at_start);
    for (std::int32_t slot = 0; slot < static_cast<std::int32_t>(trace.at_start.stored_bricks()); ++slot) {
        const BrickFractions before = trace.at_start.fractions(slot);
        const BrickFractions after = trace.at_end.fractions(slot);
        if (std::ranges::equal(before, after)) continue;
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
            if (before[offset] >= half_a_voxel && int{before[offset]} - int{after[offset]} >= half_a_voxel)
                cavity.set(slot, offset);
    }
    return cavity;
}

}  // namespace osteomill
