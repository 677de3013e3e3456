#include "simulation/loop/real_time.h"

#include <fmt/format.h>
#include <linux/capability.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>

namespace osteomill {

namespace {

bool has_capability(unsigned capability) noexcept {
    __user_cap_header_struct header{.version = _LINUX_CAPABILITY_VERSION_3, .pid = 0};
    std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> data{};
    if (syscall(SYS_capget, &header, data.data()) != 0) return false;
    return (data[capability / 32].effective & (1U << capability % 32)) != 0;
}

rlim_t limit_of(int resource) noexcept {
    rlimit limit{};
    return getrlimit(static_cast<__rlimit_resource_t>(resource), &limit) == 0 ? limit.rlim_cur : 0;
}

}  // namespace

RealTimeRights real_time_rights() noexcept {
    return {.priority = has_capability(CAP_SYS_NICE) || limit_of(RLIMIT_RTPRIO) >= device_priority,
            .memory = has_capability(CAP_IPC_LOCK) || limit_of(RLIMIT_MEMLOCK) == RLIM_INFINITY};
}

std::string advice_on_rights(const RealTimeRights& rights, const std::string& program) {
    if (rights.priority && rights.memory) return "";
    const char* missing = "no right to real-time priority";
    if (rights.priority) missing = "no right to lock memory";
    if (!rights.priority && !rights.memory) missing = "no right to real-time priority, nor to lock memory";
    return fmt::format(
        "{}: ticks may come late on a busy machine, and the force fades out when they do; run 'sudo setcap "
        "cap_sys_nice,cap_ipc_lock+ep {}', or start it as scripts/systemd/osteomill.service does",
        missing, program);
}

bool lock_memory() noexcept {
    if (!real_time_rights().memory) return false;
    return mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
}

void touch_stack() noexcept {
    std::array<volatile unsigned char, touched_stack_bytes> stack;
    constexpr std::size_t page_bytes = 4096;
    for (std::size_t i = 0; i < stack.size(); i += page_bytes) stack[i] = 0;
}

std::uint64_t page_faults_of_this_thread() noexcept {
    rusage usage{};
    if (getrusage(RUSAGE_THREAD, &usage) != 0) return 0;
    return static_cast<std::uint64_t>(usage.ru_minflt) + static_cast<std::uint64_t>(usage.ru_majflt);
}

std::vector<int> usable_cpus() {
    cpu_set_t set;
    CPU_ZERO(&set);
    std::vector<int> cpus;
    if (sched_getaffinity(0, sizeof set, &set) != 0) return cpus;
    for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
        if (CPU_ISSET(static_cast<unsigned>(cpu), &set)) cpus.push_back(cpu);
    return cpus;
}

bool bind_to_cpu(int cpu) noexcept {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(static_cast<unsigned>(cpu), &set);
    return pthread_setaffinity_np(pthread_self(), sizeof set, &set) == 0;
}

bool ask_for_real_time(int priority) noexcept {
    prctl(PR_SET_TIMERSLACK, 1UL);
    sched_param parameters{};
    parameters.sched_priority = priority;
    return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0;
}

}  // namespace osteomill
