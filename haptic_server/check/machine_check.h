// Checks of the machine that haptic_server --check makes, for conditions that make the loops late.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "devices/hid/hid_transport.h"
#include "haptic_server/check/check_row.h"
#include "simulation/loop/real_time.h"

namespace osteomill {

/// How late a thread with the priority of the haptic loop woke up, 1000 times a second.
struct WakeUps {
    int count = 0;
    double p99_us = 0.0;
    double latest_us = 0.0;
};

/// The machine as it is; a test gives its own.
struct CheckedMachine {
    std::filesystem::path root = "/";  ///< where /proc, /sys and /dev are
    std::string program;               ///< the file that was started
    RealTimeRights rights{};
    std::function<WakeUps()> measure_wake_ups;
    std::function<double()> measure_clock_ns;  ///< the time that one reading of the clock takes
};

/// This one. Measuring takes half a second.
CheckedMachine this_machine();

/// Real-time priority and its share, page locking, wake-ups, preemption, frequency and idle states, the clock
/// source, the GPU; in this order. Facts that the kernel does not state (a virtual machine has no
/// frequencies) are left out.
std::vector<CheckRow> check_machine(const CheckedMachine& machine);

/// A row for the arms and 3D mice that are plugged in. Tries to open each.
CheckRow check_devices(HidTransport& transport);

}  // namespace osteomill
