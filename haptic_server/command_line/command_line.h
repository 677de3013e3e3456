// What a command line asks for.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace osteomill {

/// Options to run with, or a text (help, version) to print and be done.
template <typename Options>
struct Asked {
    std::optional<Options> options;
    std::string text;
};

/// Checks of an option's number, which name no limit that nobody could reach.
CLI::Validator above_zero();
CLI::Validator not_below_zero();

/// Fills in what `app` has declared; returns the text where help or the version is asked for. Throws
/// std::invalid_argument with one line for wrong usage.
std::optional<std::string> parse_or_text(CLI::App& app, int argc, const char* const* argv);

}  // namespace osteomill
