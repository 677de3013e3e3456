// A slice of time in which one of the two is measured: haptic_server at work, or cyclictest.
#pragma once

#include <cstdint>
#include <filesystem>

#include "studies/realtime/latencies.h"

namespace osteomill::study {

/// What haptic_server reported of its time, of one slice or several.
struct Served {
    Latencies wakeup;
    Latencies haptic_tick;
    Latencies milling_step;
    std::uint64_t ticks = 0;
    std::uint64_t late_ticks = 0;        ///< done a millisecond or more after their deadline
    std::uint64_t missed_deadlines = 0;  ///< for which no tick ran
    std::uint64_t missed_milling_steps = 0;
    std::uint64_t page_faults = 0;  ///< of both loops
    std::uint64_t overruns = 0;     ///< how often the force went off for missed deadlines
    std::uint64_t client_frames = 0;
    double removed_mm3 = 0.0;
    bool has_priority = true;
    bool has_locked_memory = true;

    void add(const Served& other);
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Served, wakeup, haptic_tick, milling_step, ticks, late_ticks, missed_deadlines,
                                   missed_milling_steps, page_faults, overruns, client_frames, removed_mm3,
                                   has_priority, has_locked_memory)

/// Runs `haptic_server` for `duration_s`: the tooth phantom on the real clock, both loops at 1 kHz, a
/// recording and two clients that keep up. Works in the folder `work`. Throws std::runtime_error in one line
/// where it fails or no client saw the session.
Served serve(const std::filesystem::path& haptic_server, double duration_s,
             const std::filesystem::path& work);

/// Runs `cyclictest` for `duration_s` as haptic_server's loop would wait: one thread at its priority (an
/// ordinary one where `has_priority` is false), a wake-up a millisecond, memory locked, and no other change
/// of the system than haptic_server makes. Throws as serve() does.
Latencies cycle(const std::filesystem::path& cyclictest, double duration_s, bool has_priority,
                const std::filesystem::path& work);

}  // namespace osteomill::study
