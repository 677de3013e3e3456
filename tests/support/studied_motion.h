// Motions that are not steady cases: polishing, tilted, plunging, a curved path, a block of two layers. All
// with the 5 mm burr.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "studies/force/bone_block.h"
#include "studies/force/path_run.h"
#include "studies/force/studied_model.h"

namespace osteomill::study {

struct StudiedMotion {
    std::string name{};
    Burr burr{};
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};
    std::function<glm::dvec3(double time_s)> position_mm{};
    double duration_s = 0.0;
    std::optional<TopLayer> layer{};  ///< on the flat bone {z <= 0}
    /// Mean over the motion, by the analytical reference at each of many instants.
    glm::dvec3 reference_n{0.0};
};

/// The five, always the same. `quick` makes them shorter.
std::vector<StudiedMotion> studied_motions(bool quick);

/// How a bone is cut into voxels and a motion into steps.
struct Discretisation {
    double voxel_mm = 0.1;
    double milling_rate_hz = 100.0;
    /// The lattice's shift relative to the motion: a mean over several tells more than one.
    glm::dvec3 lattice_shift_mm{0.031, 0.017, 0.0};
    /// How long the burr moves before it is measured: a model that remembers must forget how it was put into
    /// the bone.
    double run_in_s = 0.0;
};

ForceSeries run_motion(const StudiedMotion& motion, const Discretisation& discretisation,
                       const MakeModel& make_model);

}  // namespace osteomill::study
