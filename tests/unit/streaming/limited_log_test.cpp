#include <gmock/gmock.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <sstream>

#include "common/log/rate_limit.h"

namespace osteomill {
namespace {

using std::chrono::seconds;

class LimitedLogTest : public ::testing::Test {
  protected:
    LimitedLogTest() { spdlog::set_default_logger(logger_); }
    ~LimitedLogTest() override { spdlog::set_default_logger(before_); }

    std::size_t lines() const {
        const std::string text = text_.str();
        return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    }

    std::ostringstream text_;
    std::shared_ptr<spdlog::logger> before_ = spdlog::default_logger();
    std::shared_ptr<spdlog::logger> logger_ =
        std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text_));
};

TEST_F(LimitedLogTest, WritesAFewLinesOfAFloodAndCountsTheRest) {
    LimitedLog log;
    const LimitedLog::Time start{};
    for (int i = 0; i < 1000; ++i) log.write(LogLevel::warning, "a client was refused", start);
    const auto at_once = static_cast<std::size_t>(LimitedLog::lines_at_once);
    EXPECT_EQ(lines(), at_once);
    log.tell_left_out(start);
    EXPECT_EQ(lines(), at_once) << "there is no room yet";
    log.tell_left_out(start + seconds(2));
    EXPECT_EQ(lines(), at_once + 1);
    EXPECT_THAT(text_.str(),
                ::testing::HasSubstr(std::to_string(1000 - at_once) + " lines like this were left out"));
    log.tell_left_out(start + seconds(60));
    EXPECT_EQ(lines(), at_once + 1) << "it has been told";
}

}  // namespace
}  // namespace osteomill
