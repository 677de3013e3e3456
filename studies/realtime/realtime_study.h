// The study of real time: how late the haptic loop wakes and how long it takes, next to cyclictest.
//
// On few processors the two cannot run at once without one being the other's load. They take turns, ten
// seconds each, under the same priority, so that what else the machine does falls on both; first as the
// machine is, then under stress-ng. haptic_server works all the while: two clients, a recording, milling at 1
// kHz; cyclictest does nothing but wake.
#pragma once

#include <filesystem>

#include "analysis/output/surroundings.h"

namespace osteomill::study {

struct RealtimeStudyOptions {
    std::filesystem::path out;
    bool quick = false;         ///< 9 s in slices of 3: under a minute and a half, and no measure of a tail
    double duration_s = 600.0;  ///< that each is measured, without load and again under it; whole slices
};

/// Writes realtime.json, latencies.csv and realtime.svg into `options.out`. What is
/// not installed (cyclictest, stress-ng) is left out with a line that says so. Throws std::runtime_error in
/// one line where haptic_server is not beside this program, something fails or cannot be written.
void run_realtime_study(const RealtimeStudyOptions& options, const StudySurroundings& surroundings);

}  // namespace osteomill::study
