#include "devices/wake_up.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>

namespace osteomill {

WakeUp::WakeUp() : event_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    if (event_ < 0) throw std::system_error(errno, std::generic_category(), "no eventfd can be had");
}

WakeUp::~WakeUp() {
    close(event_);
}

void WakeUp::wake() noexcept {
    const std::uint64_t once = 1;
    static_cast<void>(!write(event_, &once, sizeof once));  // full is awake, too
}

void WakeUp::wait(int longest_ms) noexcept {
    pollfd wait{event_, POLLIN, 0};
    std::uint64_t times = 0;
    if (poll(&wait, 1, longest_ms) > 0) static_cast<void>(!read(event_, &times, sizeof times));
}

}  // namespace osteomill
