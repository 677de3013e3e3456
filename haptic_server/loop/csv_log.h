// A file of samples, one line each, that a real-time loop may write to: the loop only queues, somebody else
// writes.
#pragma once

#include <fmt/format.h>

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace osteomill {

/// The file behind a log. After a failed write (a full disk) nothing more is written and error() says why.
class CsvFile {
  public:
    /// Creates the file and writes the header line. Throws std::runtime_error with one line naming the file.
    CsvFile(const std::filesystem::path& file, const std::string& header_line);

    void write(const fmt::memory_buffer& text);
    /// What the system could not store shows here at the latest.
    void close();
    /// One line, empty while all is well.
    const std::string& error() const { return error_; }
    const std::filesystem::path& path() const { return path_; }

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    void fail();

    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Close> file_;
    std::string error_;
};

/// `Sample` has a static `header_line` that ends in a line feed, a static `capacity` (samples that may wait
/// between two drains) and `void append_to(fmt::memory_buffer&) const`, which writes its line.
template <typename Sample>
class CsvLog {
  public:
    static constexpr std::size_t capacity = Sample::capacity;

    /// Throws what CsvFile throws.
    explicit CsvLog(const std::filesystem::path& file) : file_(file, Sample::header_line), queue_(capacity) {}

    /// One loop only. When the queue is full the sample is dropped and counted. Real-time safe.
    void push(const Sample& sample) noexcept {
        if (!queue_.push(sample)) dropped_.fetch_add(1, std::memory_order_relaxed);
    }
    /// Any one other thread: writes what is queued.
    void drain() {
        fmt::memory_buffer text;
        queue_.consume_all([&text](const Sample& sample) { sample.append_to(text); });
        file_.write(text);
    }
    /// Writes what is left and closes the file.
    void close() {
        drain();
        file_.close();
    }

    std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }
    const std::string& error() const { return file_.error(); }
    const std::filesystem::path& path() const { return file_.path(); }

  private:
    CsvFile file_;
    boost::lockfree::spsc_queue<Sample> queue_;
    std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace osteomill
