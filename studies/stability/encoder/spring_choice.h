// Gain and cost of a stiffer spring for each shipped arm, beside the spring that it gets: bandwidth of the
// force on the hand, and what is felt of encoder steps in the tooth scene.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/output/surroundings.h"
#include "devices/simulated/arm_model.h"

namespace osteomill::study {

/// Simulated arms with the mass, encoder and claim of each that is shipped; friction as the simulated arm's
/// where it is not known.
std::vector<std::pair<std::string, ArmModel>> shipped_arms();

/// springs.csv and springs.svg in `out`, a folder that is there: for each arm and spring the bandwidth up to
/// which a slot's force is passed, 0.71 of it at least (force_response.h), and noise_of() its forces in the
/// tooth scene. Throws std::runtime_error in one line where a file cannot be written.
void run_spring_study(const std::filesystem::path& out, const StudySurroundings& surroundings);

}  // namespace osteomill::study
