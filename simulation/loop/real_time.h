// The system's means for punctual threads: priority, resident memory, and a processor.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace osteomill {

/// The rights that this process may request.
struct RealTimeRights {
    bool priority = false;  ///< SCHED_FIFO: CAP_SYS_NICE, or a limit on rtprio
    bool memory = false;    ///< locking all memory: CAP_IPC_LOCK, or no limit on memlock
};

RealTimeRights real_time_rights() noexcept;

/// One line with the missing right, its consequence and the command to run; empty if none is missing.
/// `program` is the file that was started.
std::string advice_on_rights(const RealTimeRights& rights, const std::string& program);

/// Keeps every page of the process in memory, those of today and those to come, so that no tick waits for
/// one. Only with the right to do so without limit: under a limit, later allocations would fail. Returns
/// whether it is so.
bool lock_memory() noexcept;

/// Touches as much of the calling thread's stack as its loop may ever use, so that its first deep call finds
/// it there.
void touch_stack() noexcept;
inline constexpr std::size_t touched_stack_bytes = 256 * 1024;

/// Pages that the calling thread had to wait for since it began: from memory or made (minor), or from the
/// disk.
std::uint64_t page_faults_of_this_thread() noexcept;

/// Processors that this process may run on.
std::vector<int> usable_cpus();

/// Binds the calling thread to one of them; false if the system does not.
bool bind_to_cpu(int cpu) noexcept;

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
