// Scheduling of the threads of the loops.
#pragma once

namespace osteomill {

/// Priorities under SCHED_FIFO, 1 to 99: above ordinary threads, below the kernel's own (50). Threads that
/// others wait for come first.
inline constexpr int device_priority = 45;  ///< talks to a device; mostly waits
inline constexpr int haptic_priority = 40;
inline constexpr int milling_priority = 30;

/// Asks for SCHED_FIFO at `priority` and for sleeps that end when asked (Linux lets them overrun by 50 us
/// otherwise), for the calling thread. Returns whether the system granted SCHED_FIFO; without the privilege
/// (CAP_SYS_NICE or an rtprio limit) the thread goes on as an ordinary one and will miss deadlines on a busy
/// machine.
bool ask_for_real_time(int priority) noexcept;

}  // namespace osteomill
