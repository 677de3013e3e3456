// The share of an oscillating force that a coupling passes to the hand. A hand on rails goes through a slot 1
// mm deep with a 5 mm burr at 10 000 rpm, at 4 mm/s that swing by 1 mm/s; it is compared with a burr that is
// rigidly fixed to the hand.
#pragma once

#include <complex>
#include <string>

namespace osteomill::study {

struct ForceResponse {
    std::complex<double>
        response{};                ///< force on the hand relative to that on the rigid burr, at the frequency
    double rigid_n_s_per_m = 0.0;  ///< the rigid burr's force per velocity of the hand
};

/// Milling at 1 kHz. Throws std::invalid_argument for an unknown coupling, a stiffness that is not above 0,
/// and a frequency beyond 0.1 to 100 Hz.
ForceResponse respond(const std::string& coupling, double stiffness_n_per_mm, double hz);

}  // namespace osteomill::study
