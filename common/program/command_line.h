// Outcome of parsing a command line.
#pragma once

#include <optional>
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

/// Fills in what `app` has declared; returns the text where help or the version is requested. Throws
/// std::invalid_argument with one line for wrong usage.
std::optional<std::string> parse_or_text(CLI::App& app, int argc, const char* const* argv);

}  // namespace osteomill
