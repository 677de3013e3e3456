// The older contact models: the force of each on a burr that rests in flat bone.
#pragma once

#include <string>
#include <vector>

namespace osteomill::study {

/// The models of force_models.h that know no cutting law.
std::vector<std::string> contact_models();

/// Length of the force that a model feels of an upright 5 mm burr, spindle off, over 0.1 mm voxels, N.
double resting_force_n(const std::string& model, double depth_mm);

}  // namespace osteomill::study
