#include "common/log/line_sink.h"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <array>
#include <mutex>
#include <string>
#include <utility>

#include "common/text/plain_text.h"

namespace osteomill {

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
