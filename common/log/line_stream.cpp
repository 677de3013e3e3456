#include "common/log/line_stream.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <ctime>
#include <utility>

#include "common/text/plain_text.h"

namespace osteomill {

namespace {

/// `line` is printable: UTF-8 without control characters.
std::string json_line(std::string_view line, const char* level) {
    std::string quoted;
    for (const char letter : line) {
        if (letter == '"' || letter == '\\') quoted += '\\';
        quoted += letter;
    }
    const auto now = std::chrono::system_clock::now().time_since_epoch() / std::chrono::milliseconds(1);
    return fmt::format(R"({{"time":"{:%FT%T}.{:03}Z","level":"{}","message":"{}"}})",
                       fmt::gmtime(static_cast<std::time_t>(now / 1000)), now % 1000, level, quoted);
}

}  // namespace

LineStream::LineStream(int descriptor, std::size_t capacity_bytes)
    : writer_(descriptor, capacity_bytes), is_terminal_(::isatty(descriptor) == 1) {}

void LineStream::write(std::string text) {
    if (!is_json_) return push(std::move(text));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (!line.empty()) say(line);
}

void LineStream::push(std::string text) {
    const std::scoped_lock lock(mutex_);
    say_dropped();
    // Lines keep their order: none passes those that are missing.
    if (dropped_ > 0 || !writer_.push(std::move(text))) ++dropped_;
}

void LineStream::say(std::string_view line, const char* level) {
    push((is_json_ ? json_line(printable(line), level) : printable(line)) + "\n");
}

void LineStream::say_dropped() {
    if (dropped_ == 0) return;
    const std::string line = fmt::format("({} lines are missing here: nobody took them)", dropped_);
    if (writer_.push((is_json_ ? json_line(line, "warning") : line) + "\n")) dropped_ = 0;
}

int LineStreamBuffer::sync() {
    if (std::string text = str(); !text.empty()) stream_.write(std::move(text));
    str({});
    return 0;
}

void LineStream::finish() {
    {
        const std::scoped_lock lock(mutex_);
        say_dropped();
    }
    writer_.finish();
}

}  // namespace osteomill
