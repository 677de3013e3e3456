#include "tests/support/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

namespace osteomill::testing {

using Clock = std::chrono::steady_clock;

ChildProcess::ChildProcess(const std::vector<std::string>& command, const Streams& instead) {
    const std::array given{instead.out, instead.err};
    std::array<std::array<int, 2>, 2> pipes{{{-1, -1}, {-1, -1}}};
    for (std::size_t i = 0; i < 2; ++i)
        if (given[i] < 0 && ::pipe2(pipes[i].data(), O_CLOEXEC) != 0)
            throw std::system_error(errno, std::generic_category(), "pipe");
    std::vector<char*> arguments;
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (pid_ == 0) {
        ::dup2(given[0] < 0 ? pipes[0][1] : given[0], STDOUT_FILENO);
        ::dup2(given[1] < 0 ? pipes[1][1] : given[1], STDERR_FILENO);
        ::execv(arguments[0], arguments.data());
        ::_exit(127);
    }
    for (std::size_t i = 0; i < 2; ++i) {
        if (given[i] < 0) ::close(pipes[i][1]);
        streams_[i].descriptor = pipes[i][0];
    }
}

ChildProcess::~ChildProcess() {
    if (!status_ && pid_ > 0) {
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
    }
    for (Stream& stream : streams_)
        if (stream.descriptor >= 0) ::close(stream.descriptor);
}

bool ChildProcess::pump(std::chrono::milliseconds at_most) {
    std::array<pollfd, 2> watched{};
    for (std::size_t i = 0; i < 2; ++i)
        watched[i] = {.fd = streams_[i].descriptor, .events = POLLIN, .revents = 0};
    if (watched[0].fd < 0 && watched[1].fd < 0) return false;
    if (::poll(watched.data(), 2, static_cast<int>(at_most.count())) <= 0) return true;
    for (std::size_t i = 0; i < 2; ++i) {
        if (watched[i].fd < 0 || watched[i].revents == 0) continue;
        std::array<char, 4096> buffer{};
        const ssize_t count = ::read(watched[i].fd, buffer.data(), buffer.size());
        if (count > 0) {
            streams_[i].text.append(buffer.data(), static_cast<std::size_t>(count));
        } else {
            ::close(watched[i].fd);
            streams_[i].descriptor = -1;
        }
    }
    return true;
}

std::optional<std::string> ChildProcess::line_after(const std::string& prefix,
                                                    std::chrono::seconds deadline) {
    const auto end = Clock::now() + deadline;
    for (;;) {
        for (std::size_t start = 0; start < out().size();) {
            const std::size_t stop = out().find('\n', start);
            if (stop == std::string::npos) break;
            if (out().compare(start, prefix.size(), prefix) == 0)
                return out().substr(start + prefix.size(), stop - start - prefix.size());
            start = stop + 1;
        }
        if (Clock::now() >= end || !pump(std::chrono::milliseconds(100))) return std::nullopt;
    }
}

std::optional<int> ChildProcess::wait(std::chrono::seconds deadline) {
    const auto end = Clock::now() + deadline;
    while (!status_) {
        const bool open = pump(std::chrono::milliseconds(50));
        int raw = 0;
        const pid_t ended = ::waitpid(pid_, &raw, open ? WNOHANG : 0);
        if (ended == pid_) {
            status_ = WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw);
            while (pump(std::chrono::milliseconds(50))) {
            }
        } else if (Clock::now() >= end) {
            return std::nullopt;
        }
    }
    return status_;
}

void ChildProcess::send_signal(int signal) const {
    ::kill(pid_, signal);
}

Finished run_program(const std::vector<std::string>& command, std::chrono::seconds deadline) {
    ChildProcess program(command);
    const std::optional<int> status = program.wait(deadline);
    return {status.value_or(-1), program.out(), program.err()};
}

}  // namespace osteomill::testing
