// Checks of the machine that haptic_server --check makes, for conditions that make the loops late; and the
// rows in which all its findings are printed.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "devices/hid/hid_transport.h"
#include "simulation/loop/real_time.h"

namespace osteomill {

/// Finding of haptic_server --check: the thing checked, its fault, the fault's cost, the remedy.
struct CheckRow {
    std::string what;    ///< such as "page locking"
    std::string found;   ///< as it is: "allowed", "not allowed"
    std::string cost{};  ///< the effect that a user notices; empty: nothing is wrong
    std::string mend{};  ///< a command, or advice if none helps
    /// A session goes without: it costs comfort, not safety or data.
    bool can_wait = false;

    bool is_right() const { return cost.empty(); }
};

/// A line for each that is right, three for each that is not, and a last one that says how many are wrong.
std::string text_of(const std::vector<CheckRow>& rows);

/// Whether something is wrong that cannot wait.
bool must_be_mended(const std::vector<CheckRow>& rows);

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
