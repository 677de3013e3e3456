// Lines for people, on a terminal or in a file, from threads that must not wait for it.
//
// Lines that do not fit the queue are dropped and counted, and the count is reported as soon as lines fit
// again. A stream that fails (a full disk, a closed pipe, a terminal that is gone) is given up quietly: a
// failing log must not end the program.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <sstream>
#include <string>
#include <string_view>

#include "common/log/text_writer.h"

namespace osteomill {

class LineStream {
  public:
    /// Some thousand lines.
    static constexpr std::size_t default_capacity_bytes = 256 * 1024;

    explicit LineStream(int descriptor, std::size_t capacity_bytes = default_capacity_bytes);

    /// From now on each line is a JSON object with time (UTC), level and message. Before there are other
    /// threads.
    void use_json() { is_json_ = true; }
    bool is_json() const { return is_json_; }

    // Any thread; none of these waits for the descriptor but finish().

    /// `text`: one or more whole lines, or one that is to be overwritten; text of this program only.
    void write(std::string text);
    /// One line, whatever is in it: printable (foreign_text.h), and a line break behind it. `level`, as of a
    /// log, is for JSON.
    void say(std::string_view line, const char* level = "info");
    /// Whether everything is written, or never will be: a line that matters only now should not queue behind
    /// older lines.
    bool has_caught_up() const { return writer_.is_idle(); }
    /// Whether a line can be overwritten.
    bool is_terminal() const { return is_terminal_ && !is_json_; }
    /// Waits as TextWriter::finish does; later lines are discarded.
    void finish();

  private:
    void push(std::string text);
    void say_dropped();

    TextWriter writer_;
    const bool is_terminal_;
    bool is_json_ = false;
    std::mutex mutex_;
    std::uint64_t dropped_ = 0;
};

/// An ordinary stream whose text goes there whenever it is flushed.
class LineStreamBuffer final : public std::stringbuf {
  public:
    /// `stream` outlives it.
    explicit LineStreamBuffer(LineStream& stream) : stream_(stream) {}
    ~LineStreamBuffer() override { LineStreamBuffer::sync(); }
    LineStreamBuffer(const LineStreamBuffer&) = delete;
    LineStreamBuffer& operator=(const LineStreamBuffer&) = delete;

  protected:
    int sync() override;

  private:
    LineStream& stream_;
};

// The log of a program (log.h) as lines of a stream that never blocks the caller.

/// Makes the log go to `stream`, each line headed with time, `program` and level, the level in
/// colour on a terminal. A line that cannot be formatted is left out.
void log_to(std::shared_ptr<LineStream> stream, const std::string& program);

/// Lines of a program on its standard output and standard error while it runs. Neither can hold it up.
struct ProgramOutput {
    /// For programs that wait for a line.
    std::shared_ptr<LineStream> out = std::make_shared<LineStream>(STDOUT_FILENO);
    /// For people; the log goes there, too.
    std::shared_ptr<LineStream> err = std::make_shared<LineStream>(STDERR_FILENO);

    /// Last: waits for both for a bounded time. Later output is discarded.
    void finish() const {
        out->finish();
        err->finish();
    }
};

}  // namespace osteomill
