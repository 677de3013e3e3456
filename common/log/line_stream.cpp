#include "common/log/line_stream.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <ctime>
#include <mutex>
#include <string>
#include <utility>

#include "common/text/foreign_text.h"

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

namespace {

/// By spdlog's levels: trace, debug, info, warning, error, critical; as spdlog colours them.
constexpr std::array<const char*, SPDLOG_LEVEL_OFF + 1> colours{
    "\033[37m", "\033[36m", "\033[32m", "\033[33m\033[1m", "\033[31m\033[1m", "\033[1m\033[41m", ""};
constexpr const char* no_colour = "\033[m";

/// spdlog's own asynchronous logger waits for its thread at the end, and its sinks throw if a stream fails.
class LineSink final : public spdlog::sinks::base_sink<std::mutex> {
  public:
    explicit LineSink(std::shared_ptr<LineStream> stream) : stream_(std::move(stream)) {}

  private:
    void sink_it_(const spdlog::details::log_msg& message) override {
        // A message is one line, whatever names and reasons are in it.
        if (stream_->is_json())
            return stream_->say({message.payload.data(), message.payload.size()},
                                spdlog::level::to_string_view(message.level).data());
        const std::string payload =
            printable(std::string_view(message.payload.data(), message.payload.size()));
        spdlog::details::log_msg printed = message;
        printed.payload = payload;
        spdlog::memory_buf_t line;
        formatter_->format(printed, line);
        std::string text(line.data(), line.size());
        if (stream_->is_terminal() && printed.color_range_end > printed.color_range_start) {
            text.insert(printed.color_range_end, no_colour);
            text.insert(printed.color_range_start, colours.at(static_cast<std::size_t>(message.level)));
        }
        stream_->write(std::move(text));
    }
    void flush_() override {}

    std::shared_ptr<LineStream> stream_;
};

}  // namespace

void log_to(std::shared_ptr<LineStream> stream, const std::string& program) {
    auto logger = std::make_shared<spdlog::logger>(program, std::make_shared<LineSink>(std::move(stream)));
    // By default it would be written to standard error there and then.
    logger->set_error_handler([](const std::string&) {});
    spdlog::set_default_logger(std::move(logger));
}

}  // namespace osteomill
