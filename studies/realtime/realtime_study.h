// The study of real time: how late the haptic loop wakes and how long it takes, next to cyclictest.
//
// On few processors the two cannot run at once without one being the other's load. They take turns, ten
// seconds each, under the same priority, so that what else the machine does falls on both; first as the
// machine is, then under stress-ng. haptic_server works all the while: two clients, a recording, milling at 1
// kHz; cyclictest does nothing but wake.
#pragma once

#include "analysis/output/study_command.h"

namespace osteomill::study {

/// `osteomill_study realtime`: writes realtime.json, latencies.csv and realtime.svg. What is not installed
/// (cyclictest, stress-ng) is left out with a line that says so; haptic_server must be beside this program.
StudyCommand add_realtime(CLI::App& app);

}  // namespace osteomill::study
