#include "common/recording/recording_writer.h"

#include <utility>

namespace osteomill {

RecordingWriter::RecordingWriter(std::filesystem::path file,
                                 std::function<void(const std::string&)> on_failure)
    : packets_(std::move(file)), on_failure_(std::move(on_failure)) {
    report_.file = packets_.file();
    report_.bytes = packets_.bytes();
    thread_ = std::thread([this] { run(); });
}

RecordingWriter::~RecordingWriter() {
    close();
}

bool RecordingWriter::has_room() const {
    const std::scoped_lock lock(mutex_);
    return waiting_bytes_ < capacity_bytes;
}

void RecordingWriter::wait_for_room() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_bytes_ < capacity_bytes; });
}

void RecordingWriter::wait_until_written() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_bytes_ == 0; });
}

void RecordingWriter::push(Stamp stamp, std::string message) {
    {
        const std::scoped_lock lock(mutex_);
        if (is_closing_ || !report_.error.empty()) return;
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

RecordingReport RecordingWriter::report() const {
    const std::scoped_lock lock(mutex_);
    return report_;
}

void RecordingWriter::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return is_closing_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        const Waiting next = std::move(waiting_.front());
        waiting_.pop_front();
        std::string error;
        lock.unlock();
        try {
            packets_.write(next.stamp, next.message);
        } catch (const std::exception& failure) {
            error = failure.what();
        }
        if (!error.empty() && on_failure_) on_failure_(error);
        lock.lock();
        waiting_bytes_ -= next.message.size();
        report_.frames = packets_.packets();
        report_.bytes = packets_.bytes();
        if (!error.empty()) {
            report_.error = std::move(error);
            waiting_.clear();
            waiting_bytes_ = 0;
        }
        changed_.notify_all();
        if (!report_.error.empty()) return;
    }
}

}  // namespace osteomill
