#include "imaging/dicom/apart.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
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
    // It outlives nobody who waits for it, and leaves no core if it falls.
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rlimit none{};
    ::setrlimit(RLIMIT_CORE, &none);
    ::_exit(quietly(step) ? 0 : 1);
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

bool succeeds_apart(const std::function<bool()>& step) {
    const pid_t child = ::fork();
    if (child < 0) fail("no process for decoding");
    if (child == 0) run(step);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return false;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace osteomill
