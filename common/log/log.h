// The program's log, a line at a time, from any thread. spdlog writes it (log_to), but only log.cpp sees
// spdlog: its header and its formatting take the compiler 3 s in every object.
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace osteomill {

enum class LogLevel { info, warning, error };

void log_line(LogLevel level, std::string_view line);

/// Filled in as by fmt::format.
template <typename... Values>
void log_info(fmt::format_string<Values...> text, Values&&... values) {
    log_line(LogLevel::info, fmt::format(text, std::forward<Values>(values)...));
}
template <typename... Values>
void log_warning(fmt::format_string<Values...> text, Values&&... values) {
    log_line(LogLevel::warning, fmt::format(text, std::forward<Values>(values)...));
}
template <typename... Values>
void log_error(fmt::format_string<Values...> text, Values&&... values) {
    log_line(LogLevel::error, fmt::format(text, std::forward<Values>(values)...));
}

}  // namespace osteomill
