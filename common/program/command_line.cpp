#include "common/program/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <stdexcept>

#include "common/program/option_checks.h"

namespace osteomill {

std::optional<std::string> parse_or_text(CLI::App& app, int argc, const char* const* argv) {
    try {
        parse_arguments(app, argc, argv);
    } catch (const CLI::CallForHelp&) {
        return app.help();
    } catch (const CLI::CallForVersion&) {
        return app.version() + "\n";
    } catch (const CLI::ParseError& error) {
        throw std::invalid_argument(fmt::format("{}; see --help", error.what()));
    }
    return std::nullopt;
}

}  // namespace osteomill
