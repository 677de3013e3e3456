#include "common/log/background_writer.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

namespace osteomill {

namespace {

using Clock = std::chrono::steady_clock;

/// So much at a time, that progress shows.
constexpr std::size_t most_at_once_bytes = 65'536;

bool can_be_written_to(int descriptor) {
    pollfd watched{.fd = descriptor, .events = POLLOUT, .revents = 0};
    return ::poll(&watched, 1, 0) > 0;
}

/// Writes the first bytes of `text`; returns errno if that fails. Waits if it must.
int write_some(int descriptor, const char* text, std::size_t bytes, std::size_t& written) {
    for (;;) {
        const ssize_t count = ::write(descriptor, text, std::min(bytes, most_at_once_bytes));
        if (count >= 0) {
            written = static_cast<std::size_t>(count);
            return 0;
        }
        if (errno == EINTR) continue;
        if (errno != EAGAIN) return errno;
        // Somebody else made it one that does not wait.
        pollfd watched{.fd = descriptor, .events = POLLOUT, .revents = 0};
        ::poll(&watched, 1, -1);
    }
}

}  // namespace

/// State that the thread and its owner share; it lives as long as either of them.
struct BackgroundWriter::Shared {
    Shared(int its_descriptor, std::size_t its_capacity_bytes)
        : descriptor(its_descriptor), capacity_bytes(its_capacity_bytes) {}
    ~Shared() {
        if (descriptor >= 0) ::close(descriptor);
    }
    Shared(const Shared&) = delete;
    Shared& operator=(const Shared&) = delete;

    bool has_all() const { return waiting_bytes == 0 || error != 0; }

    const int descriptor;
    const std::size_t capacity_bytes;
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<std::string> waiting;
    std::size_t waiting_bytes = 0;  // with what is being written
    std::uint64_t progress = 0;     // writes that took something
    bool has_thread = false;
    bool is_closing = false;
    int error = 0;
};

BackgroundWriter::BackgroundWriter(int descriptor, std::size_t capacity_bytes)
    : shared_(std::make_shared<Shared>(::fcntl(descriptor, F_DUPFD_CLOEXEC, 3), capacity_bytes)) {
    if (shared_->descriptor < 0) shared_->error = errno;
}

BackgroundWriter::~BackgroundWriter() {
    finish();
}

bool BackgroundWriter::push(std::string text) {
    const std::scoped_lock lock(shared_->mutex);
    if (shared_->is_closing || shared_->error != 0 || text.empty()) return true;
    if (shared_->waiting_bytes > 0 && shared_->waiting_bytes + text.size() > shared_->capacity_bytes)
        return false;
    shared_->waiting_bytes += text.size();
    shared_->waiting.push_back(std::move(text));
    if (!std::exchange(shared_->has_thread, true)) std::thread([shared = shared_] { run(shared); }).detach();
    shared_->changed.notify_all();
    return true;
}

bool BackgroundWriter::is_idle() const {
    const std::scoped_lock lock(shared_->mutex);
    return shared_->has_all();
}

void BackgroundWriter::wait_until_idle() const {
    std::unique_lock lock(shared_->mutex);
    shared_->changed.wait(lock, [this] { return shared_->has_all(); });
}

int BackgroundWriter::error() const {
    const std::scoped_lock lock(shared_->mutex);
    return shared_->error;
}

bool BackgroundWriter::finish() {
    std::unique_lock lock(shared_->mutex);
    if (std::exchange(shared_->is_closing, true)) return shared_->has_all();
    shared_->changed.notify_all();
    Clock::time_point moved = Clock::now();
    Clock::time_point took_any = moved;
    for (std::uint64_t progress = shared_->progress; shared_->has_thread;) {
        shared_->changed.wait_for(lock, std::chrono::milliseconds(10));
        if (!shared_->has_thread) break;
        const Clock::time_point now = Clock::now();
        if (shared_->progress != progress) moved = took_any = now;
        progress = shared_->progress;
        if (can_be_written_to(shared_->descriptor)) took_any = now;
        if (now - took_any >= longest_block || now - moved >= longest_standstill) return shared_->has_all();
    }
    return shared_->has_all();
}

void BackgroundWriter::run(const std::shared_ptr<Shared>& shared) {
    std::unique_lock lock(shared->mutex);
    for (;;) {
        shared->changed.wait(lock, [&] { return shared->is_closing || !shared->waiting.empty(); });
        if (shared->waiting.empty()) break;
        const std::string text = std::move(shared->waiting.front());
        shared->waiting.pop_front();
        for (std::size_t begin = 0; begin < text.size() && shared->error == 0;) {
            lock.unlock();
            std::size_t written = 0;
            const int error =
                write_some(shared->descriptor, text.data() + begin, text.size() - begin, written);
            lock.lock();
            begin += written;
            ++shared->progress;
            shared->waiting_bytes -= written;
            shared->error = error;
        }
        if (shared->error != 0) {
            shared->waiting.clear();
            shared->waiting_bytes = 0;
        }
        shared->changed.notify_all();
    }
    shared->has_thread = false;
    shared->changed.notify_all();
}

}  // namespace osteomill
