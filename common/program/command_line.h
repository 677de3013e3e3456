// Outcome of parsing a command line.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <string>

namespace CLI {
class App;
}

namespace osteomill {

/// Options to run with, or a text (help, version) to print and be done.
template <typename Options>
struct ParseResult {
    std::optional<Options> options;
    std::string text;
};

/// The value that `read` makes of an option. If it throws std::invalid_argument, the message names the
/// option.
template <typename Read>
auto said_of_option(const char* option, Read&& read) {
    try {
        return read();
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(fmt::format("{}: {}", option, error.what()));
    }
}

/// Fills in what `app` has declared; returns the text if help or the version is requested. Throws
/// std::invalid_argument with one line for wrong usage.
std::optional<std::string> parse_or_text(CLI::App& app, int argc, const char* const* argv);

}  // namespace osteomill
