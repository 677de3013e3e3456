#include "common/recording/recording_writer.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "common/files/session_file.h"
#include "common/recording/pcap_file.h"

namespace osteomill {

namespace {

SessionFile begun(const std::filesystem::path& file) try {
    return SessionFile(file);
} catch (const std::runtime_error& error) {
    throw RecordingError(error.what());
}

}  // namespace

/// State that the thread and its owner share; it lives as long as either of them.
struct RecordingWriter::Shared {
    struct Waiting {
        Stamp stamp;
        std::string message;
    };

    Shared(const std::filesystem::path& path, OnNews its_on_news, WhenDiskIsFull its_when_full)
        : file(begun(path)), packets(file.part()), on_news(std::move(its_on_news)), when_full(its_when_full) {
        report.file = packets.file();
        report.bytes = packets.bytes();
    }
    ~Shared() {
        if (is_worth_keeping && packets.packets() > 0) file.keep_part();
    }
    Shared(const Shared&) = delete;
    Shared& operator=(const Shared&) = delete;

    // All with the mutex locked.

    bool has_room() const { return waiting_bytes < capacity_bytes; }
    bool has_failed() const { return !report.error.empty(); }
    bool has_ended() const { return is_given_up || (when_full == WhenDiskIsFull::end && has_failed()); }
    void forget_waiting() {
        waiting.clear();
        waiting_bytes = 0;
    }
    void give_up() {
        is_given_up = true;
        report.error = report.file.string() + ": the disk does not answer; the recording ends there";
        forget_waiting();
    }
    /// Waits until `condition` holds; gives up once nothing has been written for so long.
    template <typename Condition>
    void wait_or_give_up(std::unique_lock<std::mutex>& lock, std::chrono::milliseconds longest,
                         const Condition& condition) {
        while (!condition()) {
            const auto has_moved = [&, frames = report.frames] {
                return condition() || report.frames != frames;
            };
            if (!changed.wait_for(lock, longest, has_moved)) return give_up();
        }
    }

    // The thread's.

    void run();
    /// One line why not; empty if it has been written.
    std::string write(const Waiting& frame);
    std::string make_whole();

    SessionFile file;
    PacketWriter packets;  // the thread's
    const OnNews on_news;
    const WhenDiskIsFull when_full;
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Waiting> waiting;
    std::size_t waiting_bytes = 0;  // with what is being written
    bool is_closing = false;
    bool is_to_be_whole = false;  // once all is written
    bool is_syncing = false;
    bool has_thread = true;
    bool is_worth_keeping = true;
    bool is_given_up = false;  // the thread may be there, but its work no longer matters
    RecordingReport report;
};

RecordingWriter::RecordingWriter(const std::filesystem::path& file, OnNews on_news, WhenDiskIsFull when_full)
    : shared_(std::make_shared<Shared>(file, std::move(on_news), when_full)),
      thread_([shared = shared_] { shared->run(); }) {}

RecordingWriter::~RecordingWriter() {
    close();
}

bool RecordingWriter::has_room() const {
    const std::scoped_lock lock(shared_->mutex);
    return shared_->has_room();
}

void RecordingWriter::wait_for_room(std::chrono::milliseconds longest) {
    std::unique_lock lock(shared_->mutex);
    shared_->wait_or_give_up(lock, longest, [this] { return shared_->has_room() || shared_->has_failed(); });
}

void RecordingWriter::wait_until_written(std::chrono::milliseconds longest) {
    std::unique_lock lock(shared_->mutex);
    shared_->wait_or_give_up(lock, longest,
                             [this] { return shared_->waiting_bytes == 0 || shared_->has_failed(); });
}

void RecordingWriter::push(Stamp stamp, std::string message) {
    {
        const std::scoped_lock lock(shared_->mutex);
        if (shared_->is_closing || shared_->has_ended()) return;
        shared_->waiting_bytes += message.size();
        shared_->waiting.push_back({stamp, std::move(message)});
    }
    shared_->changed.notify_all();
}

bool RecordingWriter::has_failed() const {
    const std::scoped_lock lock(shared_->mutex);
    return shared_->has_failed();
}

void RecordingWriter::close() {
    if (!thread_.joinable()) return;
    std::unique_lock lock(shared_->mutex);
    shared_->is_closing = true;
    shared_->changed.notify_all();
    const auto has_ended = [this] { return !shared_->has_thread || shared_->is_given_up; };
    shared_->wait_or_give_up(lock, longest_standstill, [&] { return has_ended() || shared_->is_syncing; });
    if (!shared_->changed.wait_for(lock, longest_wait, has_ended)) shared_->give_up();
    const bool is_given_up = shared_->is_given_up;
    lock.unlock();
    if (is_given_up) {
        thread_.detach();
    } else {
        thread_.join();
    }
}

void RecordingWriter::commit() {
    {
        const std::scoped_lock lock(shared_->mutex);
        shared_->is_to_be_whole = true;
    }
    close();
}

void RecordingWriter::discard() {
    {
        const std::scoped_lock lock(shared_->mutex);
        shared_->is_worth_keeping = false;
    }
    close();
}

RecordingReport RecordingWriter::report() const {
    const std::scoped_lock lock(shared_->mutex);
    return shared_->report;
}

const std::optional<std::filesystem::path>& RecordingWriter::torn() const {
    return shared_->file.torn();
}

void RecordingWriter::Shared::run() {
    std::unique_lock lock(mutex);
    for (bool stands_still = false;;) {
        changed.wait(lock, [this] { return is_closing || is_given_up || !waiting.empty(); });
        if (waiting.empty()) break;
        const bool is_last_attempt = is_closing;
        Waiting next = std::move(waiting.front());
        waiting.pop_front();
        lock.unlock();
        const std::string error = write(next);
        lock.lock();
        if (is_given_up) return;
        if (on_news && error.empty() && stands_still)
            on_news(
                RecordingNews::goes_on,
                packets.file().string() + ": the recording goes on, with all that its bone lost meanwhile");
        if (on_news && !error.empty() && !stands_still) on_news(RecordingNews::stands_still, error);
        report.frames = packets.packets();
        report.bytes = packets.bytes();
        report.error = error;
        if (error.empty()) {
            waiting_bytes -= next.message.size();
            if (stands_still) ++report.pauses;
        } else if (has_ended()) {
            forget_waiting();
        } else {
            waiting.push_front(std::move(next));
        }
        stands_still = !error.empty();
        changed.notify_all();
        if (!stands_still) continue;
        if (has_ended() || is_last_attempt) break;
        changed.wait_for(lock, retry_period, [this] { return is_closing; });
    }
    if (is_to_be_whole && !has_failed()) {
        is_syncing = true;
        changed.notify_all();
        lock.unlock();
        const std::string error = make_whole();
        lock.lock();
        if (is_given_up) return;
        report.error = error;
        std::error_code failed;  // it may have its name although its folder could not be synced
        if (!std::filesystem::exists(file.part(), failed)) report.file = file.path();
    }
    has_thread = false;
    changed.notify_all();
}

std::string RecordingWriter::Shared::write(const Waiting& frame) {
    try {
        packets.write(frame.stamp, frame.message);
    } catch (const std::exception& failure) {
        return std::string(failure.what()) +
               (when_full == WhenDiskIsFull::end ? "; the recording ends there" : "");
    }
    return {};
}

std::string RecordingWriter::Shared::make_whole() {
    try {
        file.commit();
    } catch (const std::runtime_error& failure) {
        return failure.what();
    }
    return {};
}

std::string ending_of(const RecordingReport& report) {
    std::error_code failed;
    if (report.error.empty() || report.frames == 0 || !std::filesystem::is_regular_file(report.file, failed))
        return report.error;
    return report.error + "; what there is lies in " + report.file.string() + ", which packet_replay reads";
}

}  // namespace osteomill
