#include "imaging/dicom/own_process.h"

#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "imaging/dicom/quiet_libraries.h"

namespace osteomill {

namespace {

[[noreturn]] void fail(const char* what) {
    throw std::system_error(errno, std::generic_category(), what);
}

[[noreturn]] void run(const std::function<bool()>& step) {
    // The child ends with its parent, and leaves no core if it crashes.
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rlimit none{};
    ::setrlimit(RLIMIT_CORE, &none);
    ::_exit(quietly(step) ? 0 : 1);
}

double cpu_s_of(pid_t process) {
    clockid_t clock{};
    timespec used{};
    if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &used) != 0) return 0.0;
    return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

/// Waits until the child ends or stands still: true if it stands still.
bool stands_still(pid_t child, std::chrono::seconds at_most) {
    const auto watched = static_cast<int>(::syscall(SYS_pidfd_open, child, 0U));
    if (watched < 0) return false;
    constexpr std::chrono::milliseconds look_every(500);
    double used_s = 0.0;
    std::chrono::milliseconds still(0);
    while (still < at_most) {
        pollfd end{.fd = watched, .events = POLLIN, .revents = 0};
        const int ready = ::poll(&end, 1, static_cast<int>(look_every.count()));
        if (ready > 0 || (ready < 0 && errno != EINTR)) break;
        const double now_s = cpu_s_of(child);
        still = now_s > used_s ? std::chrono::milliseconds(0) : still + look_every;
        used_s = now_s;
    }
    ::close(watched);
    return still >= at_most;
}

enum class Outcome { succeeded, failed, stuck };

Outcome outcome_of(const std::function<bool()>& step, std::chrono::seconds stuck_after) {
    const pid_t child = ::fork();
    if (child < 0) fail("no process for decoding");
    if (child == 0) run(step);
    const bool is_stuck = stands_still(child, stuck_after);
    if (is_stuck) ::kill(child, SIGKILL);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return Outcome::failed;
    if (is_stuck) return Outcome::stuck;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? Outcome::succeeded : Outcome::failed;
}

}  // namespace

SharedBytes::SharedBytes(std::size_t size) {
    void* const memory =
        ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) fail("no memory for pixels");
    bytes_ = {static_cast<char*>(memory), size};
}

SharedBytes::~SharedBytes() {
    ::munmap(bytes_.data(), bytes_.size());
}

bool succeeds_apart(const std::function<bool()>& step, std::chrono::seconds stuck_after) {
    const Outcome first = outcome_of(step, stuck_after);
    return (first == Outcome::stuck ? outcome_of(step, stuck_after) : first) == Outcome::succeeded;
}

}  // namespace osteomill
