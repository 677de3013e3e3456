// Response of the force on the hand to the feed, by frequency: what spring and damper of a coupling take
// away.
#pragma once

#include <complex>
#include <filesystem>
#include <string>

#include "analysis/output/surroundings.h"

namespace osteomill::study {

struct ForceResponse {
    /// Of the force on the hand beside that on a burr that is rigidly the hand: 1 where they are the same.
    std::complex<double> response{0.0};
    double rigid_n_s_per_m = 0.0;  ///< amplitude of the latter by that of the feed
};

/// A 5 mm burr at 10 000 rpm in a slot 1 mm deep, fed along it at 4 mm/s and, about that, 1 mm/s up and down
/// at `hz` by a hand on rails; over whole periods, once the force has settled. An ideal device; both loops at
/// 1 kHz, in turns. `stiffness_n_per_mm` is the device's, so the spring's of a coupling that has one. Throws
/// std::invalid_argument for an unknown coupling or a frequency out of 0.1 to 100 Hz.
ForceResponse respond(const std::string& coupling, double stiffness_n_per_mm, double hz);

/// 0.3 to 30 Hz for several couplings and springs: response.csv and response.svg in `out`, a folder that is
/// there. Throws std::runtime_error in one line where a file cannot be written.
void run_response_study(const std::filesystem::path& out, const StudySurroundings& surroundings);

}  // namespace osteomill::study
