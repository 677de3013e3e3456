// A file of samples, one line each, that a real-time loop may write to: the loop only queues, somebody else
// makes lines of that, and a thread of the file's own waits for the disk.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "common/files/session_file.h"
#include "common/log/text_writer.h"
#include "common/session/tick_sample.h"
#include "simulation/exchange/sample_log.h"
#include "simulation/loop/milling_loop.h"

namespace osteomill {

/// The file behind a log, written by a thread of its own. After a failed write (a full disk) nothing more is
/// written and error() says why. Until it is closed its file is the part beside the one that was requested
/// (session_file.h); that stays if the log is not whole.
class CsvFile {
  public:
    /// Creates the file and writes the header line. Throws std::runtime_error with one line naming the file.
    CsvFile(const std::filesystem::path& file, const std::string& header_line);
    /// A log that was not closed stays as a part, if anything was written.
    ~CsvFile();
    CsvFile(const CsvFile&) = delete;
    CsvFile& operator=(const CsvFile&) = delete;

    /// Whether all that was written has reached the disk.
    bool is_idle() const { return writer_.is_idle(); }
    /// Waits until it has, without limit.
    void wait_until_idle() { writer_.wait_until_written(std::chrono::nanoseconds::max()); }
    /// Does not wait for the disk.
    void write(const fmt::memory_buffer& text);
    /// Failures to store lines show here at the latest. Waits for the disk, but not for ever (see
    /// TextWriter::finish).
    void close();
    /// One line, empty while all is well.
    const std::string& error() const { return error_; }
    const std::filesystem::path& path() const { return file_.path(); }
    const std::optional<std::filesystem::path>& torn() const { return file_.torn(); }

  private:
    void fail(const std::string& why);
    /// "; what there is lies in FILE", for a log that is written to a file beside its own until it is whole.
    std::string where_it_lies() const;

    SessionFile file_;
    TextWriter writer_;
    bool has_samples_ = false;
    bool is_closed_ = false;
    std::string error_;
};

/// `Sample` has a static `header_line()` that ends in a line feed, a static `capacity` (samples that may wait
/// between two drains) and `void append_to(fmt::memory_buffer&) const`, which writes its line.
template <typename Sample>
class CsvLog final : public SampleLog<Sample> {
  public:
    static constexpr std::size_t capacity = Sample::capacity;

    /// Throws as CsvFile does.
    explicit CsvLog(const std::filesystem::path& file, const std::string& header_line = Sample::header_line())
        : file_(file, header_line) {}

    /// See SampleQueue.
    void push(const Sample& sample) noexcept override { queue_.push(sample); }
    /// Any one other thread: passes the queue on, unless the disk is still writing the last part; then the
    /// queue has to last.
    void drain() override {
        if (file_.is_idle()) hand_on();
    }
    /// Drains and waits for the disk: for sessions that run on a clock of their own.
    void drain_all() override {
        file_.wait_until_idle();
        hand_on();
    }
    /// Writes the rest and closes the file.
    void close() {
        hand_on();
        file_.close();
    }

    std::uint64_t dropped() const noexcept { return queue_.dropped(); }
    const std::string& error() const { return file_.error(); }
    const std::filesystem::path& path() const { return file_.path(); }
    /// The present path of the log that an earlier, killed session left under the part's name.
    const std::optional<std::filesystem::path>& torn() const { return file_.torn(); }

  private:
    void hand_on() {
        fmt::memory_buffer text;
        queue_.consume_all([&text](const Sample& sample) { sample.append_to(text); });
        file_.write(text);
    }

    CsvFile file_;
    SampleQueue<Sample> queue_;
};

/// Logs of a session: its haptic ticks, and its milling steps.
using ForceLog = CsvLog<TickSample>;
using MillingLog = CsvLog<MillingSample>;

}  // namespace osteomill
