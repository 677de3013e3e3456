#include "common/log/line_stream.h"

#include <fmt/format.h>
#include <unistd.h>

#include <utility>

#include "common/text/plain_text.h"

namespace osteomill {

LineStream::LineStream(int descriptor, std::size_t capacity_bytes)
    : writer_(descriptor, capacity_bytes), is_terminal_(::isatty(descriptor) == 1) {}

void LineStream::write(std::string text) {
    const std::scoped_lock lock(mutex_);
    say_dropped();
    // Lines keep their order: none passes those that are missing.
    if (dropped_ > 0 || !writer_.push(std::move(text))) ++dropped_;
}

void LineStream::say(std::string_view line) {
    write(printable(line) + "\n");
}

void LineStream::say_dropped() {
    if (dropped_ == 0) return;
    if (writer_.push(fmt::format("({} lines are missing here: nobody took them)\n", dropped_))) dropped_ = 0;
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
