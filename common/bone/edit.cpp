#include "common/bone/edit.h"

#include <algorithm>

namespace osteomill {

EditOutcome apply(const EditRun& run, Bone& bone) {
    const std::int32_t slot = bone.slot(run.brick);
    if (slot == BoneContent::no_slot) return EditOutcome::no_such_brick;
    if (run.count == 0 || run.first_voxel >= brick_voxel_count ||
        run.first_voxel % brick_edge_voxels + run.count > brick_edge_voxels)
        return EditOutcome::bad_run;

    const auto row = bone.fractions(slot).subspan(run.first_voxel, run.count);
    if (!std::equal(row.begin(), row.end(), run.fraction.begin(), std::greater_equal<>{}))
        return EditOutcome::raises_fraction;
    std::copy_n(run.fraction.begin(), run.count, row.begin());
    return EditOutcome::applied;
}

}  // namespace osteomill
