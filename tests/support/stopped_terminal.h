// A terminal that Ctrl-S stops: who writes to it then waits until Ctrl-Q.
#pragma once

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace osteomill::testing {

class StoppedTerminal {
  public:
    StoppedTerminal() : keyboard_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
        if (keyboard_ >= 0 && ::grantpt(keyboard_) == 0 && ::unlockpt(keyboard_) == 0)
            screen_ = ::open(::ptsname(keyboard_), O_RDWR | O_NOCTTY | O_CLOEXEC);
        if (screen_ < 0) throw std::system_error(errno, std::generic_category(), "pseudo-terminal");
    }
    ~StoppedTerminal() {
        ::close(screen_);
        hang_up();
    }
    StoppedTerminal(const StoppedTerminal&) = delete;
    StoppedTerminal& operator=(const StoppedTerminal&) = delete;

    /// For the program that writes to it.
    int screen() const { return screen_; }
    void stop() const { type('\x13'); }
    void go_on() const { type('\x11'); }
    /// Its window is closed.
    void hang_up() {
        if (keyboard_ >= 0) ::close(keyboard_);
        keyboard_ = -1;
    }

  private:
    void type(char key) const { [[maybe_unused]] const auto ignored = ::write(keyboard_, &key, 1); }

    int keyboard_;
    int screen_ = -1;
};

}  // namespace osteomill::testing
