#include "common/recording/recording_writer.h"

#include <stdexcept>
#include <utility>

namespace osteomill {

namespace {

SessionFile begun(const std::filesystem::path& file) try {
    return SessionFile(file);
} catch (const std::runtime_error& error) {
    throw RecordingError(error.what());
}

}  // namespace

RecordingWriter::RecordingWriter(const std::filesystem::path& file, OnNews on_news, WhenDiskIsFull when_full)
    : file_(begun(file)), packets_(file_.part()), on_news_(std::move(on_news)), when_full_(when_full) {
    report_.file = packets_.file();
    report_.bytes = packets_.bytes();
    thread_ = std::thread([this] { run(); });
}

RecordingWriter::~RecordingWriter() {
    close();
    if (is_worth_keeping_ && packets_.packets() > 0) file_.keep_part();
}

bool RecordingWriter::has_room() const {
    const std::scoped_lock lock(mutex_);
    return waiting_bytes_ < capacity_bytes;
}

void RecordingWriter::wait_for_room() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_bytes_ < capacity_bytes || !report_.error.empty(); });
}

void RecordingWriter::wait_until_written() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_bytes_ == 0 || !report_.error.empty(); });
}

void RecordingWriter::push(Stamp stamp, std::string message) {
    {
        const std::scoped_lock lock(mutex_);
        if (is_closing_ || has_ended()) return;
        waiting_bytes_ += message.size();
        waiting_.push_back({stamp, std::move(message)});
    }
    changed_.notify_all();
}

bool RecordingWriter::has_failed() const {
    const std::scoped_lock lock(mutex_);
    return !report_.error.empty();
}

void RecordingWriter::close() {
    if (!thread_.joinable()) return;
    {
        const std::scoped_lock lock(mutex_);
        is_closing_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void RecordingWriter::commit() {
    close();
    if (has_failed()) return;
    std::string error;
    try {
        file_.commit();
    } catch (const std::runtime_error& failure) {
        error = failure.what();
    }
    const std::scoped_lock lock(mutex_);
    report_.error = error;
    if (error.empty()) report_.file = file_.path();
}

void RecordingWriter::discard() {
    close();
    is_worth_keeping_ = false;
}

RecordingReport RecordingWriter::report() const {
    const std::scoped_lock lock(mutex_);
    return report_;
}

void RecordingWriter::run() {
    std::unique_lock lock(mutex_);
    for (bool stands_still = false;;) {
        changed_.wait(lock, [this] { return is_closing_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        const bool is_last_attempt = is_closing_;
        // Others only append behind it, which leaves it where it is.
        const Waiting& next = waiting_.front();
        lock.unlock();
        const std::string error = write(next);
        if (on_news_ && error.empty() && stands_still)
            on_news_(
                RecordingNews::goes_on,
                packets_.file().string() + ": the recording goes on, with all that its bone lost meanwhile");
        if (on_news_ && !error.empty() && !stands_still) on_news_(RecordingNews::stands_still, error);
        lock.lock();
        report_.frames = packets_.packets();
        report_.bytes = packets_.bytes();
        report_.error = error;
        if (error.empty()) {
            waiting_bytes_ -= next.message.size();
            waiting_.pop_front();
            if (stands_still) ++report_.pauses;
        } else if (has_ended()) {
            waiting_.clear();
            waiting_bytes_ = 0;
        }
        stands_still = !error.empty();
        changed_.notify_all();
        if (!stands_still) continue;
        if (has_ended() || is_last_attempt) return;
        changed_.wait_for(lock, retry_period, [this] { return is_closing_; });
    }
}

std::string RecordingWriter::write(const Waiting& frame) {
    try {
        packets_.write(frame.stamp, frame.message);
    } catch (const std::exception& failure) {
        return std::string(failure.what()) +
               (when_full_ == WhenDiskIsFull::end ? "; the recording ends there" : "");
    }
    return {};
}

}  // namespace osteomill
