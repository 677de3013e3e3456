// Effect of the steps of an arm's encoders on the force that its hand feels: the tooth scene, milled with one
// arm after another.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/output/surroundings.h"
#include "devices/simulated/arm_model.h"

namespace osteomill::study {

struct EncoderNoise {
    double mean_force_n = 0.0;    ///< over the ticks in which there is a force
    double noise_n = 0.0;         ///< rms over those of what the force does above 5 Hz
    double largest_jump_n = 0.0;  ///< between two ticks
    double jumps_per_s = 0.0;     ///< of over 0.03 N, a second with a force
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(EncoderNoise, mean_force_n, noise_n, largest_jump_n, jumps_per_s)

/// The lesion of the tooth phantom drilled out by a firm hand on `arm` with the coupling of that name,
/// virtual clock. `stiffness_n_per_mm`: of the spring, in place of what the arm gets. `all_of`: a tissue of
/// the scene that the whole tooth is made of. Throws std::invalid_argument for an unknown coupling or tissue.
EncoderNoise drill_tooth(const ArmModel& arm, const std::string& coupling,
                         std::optional<double> stiffness_n_per_mm = std::nullopt,
                         const std::string& all_of = {});

/// Noise and jumps of a record of forces, a tick a millisecond, patient axes; without a force all 0.
EncoderNoise noise_of(const std::vector<glm::dvec3>& forces_n);

/// drill_tooth with steps from none to 0.1 mm: encoder.csv and encoder.svg in `out`, a folder that is there.
/// Throws std::runtime_error in one line where a file cannot be written.
void run_encoder_study(const std::string& coupling, const std::filesystem::path& out,
                       const StudySurroundings& surroundings);

}  // namespace osteomill::study
