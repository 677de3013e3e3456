// The cavity: the voxels of a bone that were half bone or more and lost more than half of themselves.
#pragma once

#include "analysis/report/session_trace.h"
#include "analysis/report/voxel_set.h"

namespace osteomill {

/// At the end of the session. `trace` outlives it.
VoxelSet cavity_of(const SessionTrace& trace);

}  // namespace osteomill
