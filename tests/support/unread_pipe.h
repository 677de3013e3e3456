// A pipe that nobody reads: when it is full, who writes to it waits.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <string>
#include <system_error>

namespace osteomill::testing {

class UnreadPipe {
  public:
    /// Writing to it after its end gives an error, as in the programs, and does not kill.
    UnreadPipe() {
        std::signal(SIGPIPE, SIG_IGN);
        if (::pipe2(ends_.data(), O_CLOEXEC) != 0)
            throw std::system_error(errno, std::generic_category(), "pipe");
    }
    /// One with a name, for programs that open it by that.
    explicit UnreadPipe(const std::filesystem::path& name) {
        std::signal(SIGPIPE, SIG_IGN);
        if (::mkfifo(name.c_str(), 0600) != 0)
            throw std::system_error(errno, std::generic_category(), name.string());
        ends_ = {::open(name.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC), -1};
        ends_[1] = ::open(name.c_str(), O_WRONLY | O_CLOEXEC);
    }
    ~UnreadPipe() {
        close_reader();
        close_writer();
    }
    UnreadPipe(const UnreadPipe&) = delete;
    UnreadPipe& operator=(const UnreadPipe&) = delete;

    /// To write to.
    int writer() const { return ends_[1]; }

    /// Until not a byte more fits.
    void fill() const {
        // Opened anew: the writer's own descriptor stays blocking.
        const std::string same = "/proc/self/fd/" + std::to_string(writer());
        const int impatient = ::open(same.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
        const std::array<char, 4096> nothing{};
        for (std::size_t bytes = nothing.size(); bytes > 0;)
            if (::write(impatient, nothing.data(), bytes) < 0) bytes /= 2;
        ::close(impatient);
    }

    /// The text that comes within a while, up to `bytes`, without the filling.
    std::string read(std::size_t bytes) const {
        std::string text(bytes, '\0');
        const ssize_t count = ::read(ends_[0], text.data(), bytes);
        text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
        std::erase(text, '\0');
        return text;
    }

    void close_reader() { close(ends_[0]); }
    void close_writer() { close(ends_[1]); }

  private:
    static void close(int& end) {
        if (end >= 0) ::close(end);
        end = -1;
    }

    std::array<int, 2> ends_{-1, -1};
};

}  // namespace osteomill::testing
