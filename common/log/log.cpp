#include "common/log/log.h"

#include <spdlog/spdlog.h>

namespace osteomill {

namespace {

spdlog::level::level_enum level_of(LogLevel level) {
    switch (level) {
        case LogLevel::info:
            return spdlog::level::info;
        case LogLevel::warning:
            return spdlog::level::warn;
        case LogLevel::error:
            break;
    }
    return spdlog::level::err;
}

}  // namespace

void log_line(LogLevel level, std::string_view line) {
    spdlog::log(level_of(level), spdlog::string_view_t(line.data(), line.size()));
}

}  // namespace osteomill
