#include "common/program/child_program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <thread>

namespace osteomill {

namespace {

constexpr std::chrono::milliseconds between_looks{20};

[[noreturn]] void fail(const std::string& program, int error) {
    throw std::runtime_error(fmt::format("{} cannot be run: {}", program, std::strerror(error)));
}

struct FileActions {
    FileActions() { ::posix_spawn_file_actions_init(&actions); }
    ~FileActions() { ::posix_spawn_file_actions_destroy(&actions); }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;

    posix_spawn_file_actions_t actions;
};

}  // namespace

ChildProgram::ChildProgram(const std::vector<std::string>& command, std::chrono::seconds longest_end)
    : longest_end_(longest_end) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail(command.at(0), errno);
    ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
    FileActions files;
    ::posix_spawn_file_actions_addopen(&files.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&files.actions, ends[1], STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&files.actions, ends[1], STDERR_FILENO);
    std::vector<char*> arguments;
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    const int error =
        ::posix_spawn(&pid_, command.at(0).c_str(), &files.actions, nullptr, arguments.data(), environ);
    ::close(ends[1]);
    pipe_ = ends[0];
    if (error != 0) {
        ::close(pipe_);
        fail(command.at(0), error);
    }
}

ChildProgram::~ChildProgram() {
    ask_to_end();
    const auto last = std::chrono::steady_clock::now() + longest_end_;
    while (!look_for_end(false) && std::chrono::steady_clock::now() < last) {
        read_output();  // one that writes to a full pipe does not end
        std::this_thread::sleep_for(between_looks);
    }
    if (is_running()) {
        ::kill(pid_, SIGKILL);
        look_for_end(true);
    }
    ::close(pipe_);
}

bool ChildProgram::read_output() {
    std::array<char, 4096> bytes;
    bool has_news = false;
    for (;;) {
        const ssize_t count = ::read(pipe_, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) break;
        output_.append(bytes.data(), static_cast<std::size_t>(count));
        has_news = true;
    }
    if (output_.size() > most_output_bytes) output_.erase(0, output_.size() - most_output_bytes);
    return has_news;
}

bool ChildProgram::look_for_end(bool waits) {
    if (status_) return true;
    int status = 0;
    const pid_t ended = ::waitpid(pid_, &status, waits ? 0 : WNOHANG);
    if (ended == 0 || (ended < 0 && errno == EINTR)) return false;
    status_ = ended < 0 ? -1 : WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return true;
}

bool ChildProgram::poll() {
    const bool has_ended = is_running() && look_for_end(false);
    return read_output() || has_ended;
}

std::string ChildProgram::last_line() const {
    const std::size_t end = output_.find_last_not_of("\r\n ");
    if (end == std::string::npos) return {};
    const std::size_t before = output_.find_last_of("\r\n", end);
    return output_.substr(before == std::string::npos ? 0 : before + 1, end - before);
}

void ChildProgram::ask_to_end() const {
    if (is_running()) ::kill(pid_, SIGTERM);
}

void ChildProgram::kill() const {
    if (is_running()) ::kill(pid_, SIGKILL);
}

void ChildProgram::yield_to_others() const {
    constexpr int nice = 15;
    if (is_running()) ::setpriority(PRIO_PROCESS, static_cast<id_t>(pid_), nice);
}

}  // namespace osteomill
