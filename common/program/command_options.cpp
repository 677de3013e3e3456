#include "common/program/command_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "common/text/foreign_text.h"

namespace osteomill {

namespace {

/// Behind an argument "[a,b]", which is a name, although CLI11 would split it: it would make two of it if an
/// option may be given several. No argument holds this letter.
constexpr char whole_mark = '\1';
constexpr const char* without_value = "is given without a value";

/// Names the options that an option excludes in the order of the alphabet. CLI11 keeps them by address, in
/// another order in each run, and manual pages are made of this.
class HelpFormatter : public CLI::Formatter {
  public:
    std::string make_option_opts(const CLI::Option* option) const override {
        const std::string text = CLI::Formatter::make_option_opts(option);
        std::vector<std::string> names;
        for (const CLI::Option* other : option->get_excludes()) names.push_back(other->get_name());
        if (names.empty()) return text;
        std::ranges::sort(names);
        const std::string label = " Excludes:";  // the last part of the message
        return fmt::format("{}{} {}", text.substr(0, text.find(label)), label, fmt::join(names, " "));
    }
};

/// Makes every option take the mark off its value and refuse an empty one.
void prepare(CLI::App& app) {
    for (CLI::Option* option : app.get_options())
        option->transform([](std::string text) {
            if (text.ends_with(whole_mark)) text.pop_back();
            if (text.empty()) throw CLI::ValidationError(without_value);
            return text;
        });
}

/// As CLI11 wants them, the last first.
std::vector<std::string> checked(int argc, const char* const* argv) {
    std::vector<std::string> arguments;
    for (int i = argc - 1; i > 0; --i) {
        if (const auto why = why_not_plain(argv[i]))
            throw CLI::ValidationError(
                fmt::format("argument {}, '{}', {}; names are UTF-8 without control characters", i,
                            one_line(argv[i]), *why));
        arguments.emplace_back(argv[i]);
        // CLI11 would take the next argument for it.
        if (const std::string_view option = argv[i];
            option.starts_with("--") && option.find('=') == option.size() - 1)
            throw CLI::ValidationError(std::string(option.substr(0, option.size() - 1)), without_value);
        const std::string& text = arguments.back();
        if (text.ends_with(']') && (text.starts_with('[') || text.find("=[") != std::string::npos))
            arguments.back() += whole_mark;
    }
    return arguments;
}

template <typename IsRight>
OptionCheck number_that(std::string what, std::string description, IsRight is_right) {
    return {[what = std::move(what), is_right = std::move(is_right)](const std::string& text) {
                double number = 0.0;
                if (!CLI::detail::lexical_cast(text, number)) return fmt::format("'{}' is no number", text);
                return is_right(number) ? std::string() : fmt::format("{} is not {}", text, what);
            },
            std::move(description)};
}

/// Calls `take` with the value; what it refuses is named with the option.
template <typename Value>
std::function<void(const Value&)> refusing(const std::string& option,
                                           std::function<void(const Value&)> take) {
    return [option, take = std::move(take)](const Value& value) {
        try {
            take(value);
        } catch (const std::invalid_argument& wrong) {
            throw CLI::ValidationError(option, wrong.what());
        }
    };
}

}  // namespace

OptionCheck one_of(const std::vector<std::string>& names) {
    return {[names](const std::string& value) {
                if (std::ranges::find(names, value) != names.end()) return std::string();
                return fmt::format("'{}' is not one of {}", value, fmt::join(names, ", "));
            },
            fmt::format("{}", fmt::join(names, "|"))};
}

OptionCheck above_zero() {
    return number_that("above 0", "POSITIVE", [](double number) { return number > 0.0; });
}

OptionCheck not_below_zero() {
    return number_that("0 or more", "NONNEGATIVE", [](double number) { return number >= 0.0; });
}

OptionCheck within(double low, double high) {
    return number_that(fmt::format("within {} to {}", low, high), fmt::format("{} to {}", low, high),
                       [low, high](double number) { return number >= low && number <= high; });
}

OptionCheck whole_within(int low, int high) {
    const CLI::Range range(low, high);
    return {range, range.get_description()};
}

CommandOption CommandOption::type_name(const std::string& name) const {
    option_->type_name(name);
    return *this;
}

CommandOption CommandOption::required() const {
    option_->required();
    return *this;
}

CommandOption CommandOption::check(const OptionCheck& check) const {
    option_->check(CLI::Validator(
        [why_wrong = check.why_wrong](std::string& value) { return why_wrong(value); }, check.description));
    return *this;
}

CommandOption CommandOption::shows_default() const {
    option_->capture_default_str();
    return *this;
}

CommandOption CommandOption::excludes(const std::string& other) const {
    option_->excludes(other);
    return *this;
}

CommandOption CommandOption::excludes(CommandOption other) const {
    option_->excludes(other.option_);
    return *this;
}

CommandOption CommandOption::needs(CommandOption other) const {
    option_->needs(other.option_);
    return *this;
}

CommandOption CommandOption::add_help(const std::string& line) const {
    option_->description(option_->get_description() + "\n" + line);
    return *this;
}

std::size_t CommandOption::count() const {
    return option_->count();
}

std::string CommandOption::name() const {
    return option_->get_name();
}

CommandOptions::CommandOptions(const std::string& description, const std::string& program,
                               const std::string& version)
    : app_(std::make_unique<CLI::App>(description, program)) {
    app_->set_version_flag("--version", version);
    app_->formatter(std::make_shared<HelpFormatter>());
}

CommandOptions::~CommandOptions() = default;

template <typename Value>
CommandOption CommandOptions::add_option(const std::string& name, Value& value, const std::string& help) {
    return CommandOption(*app_->add_option(name, value, help));
}

CommandOption CommandOptions::add_flag(const std::string& name, bool& value, const std::string& help) {
    return CommandOption(*app_->add_flag(name, value, help));
}

CommandOption CommandOptions::add_switch(const std::string& names, std::function<void(bool)> take,
                                         const std::string& help) {
    return CommandOption(*app_->add_flag_function(
        names, [take = std::move(take)](std::int64_t count) { take(count > 0); }, help));
}

CommandOption CommandOptions::add_texts(const std::string& name, std::vector<std::string>& texts,
                                        const std::string& help) {
    return CommandOption(*app_->add_option(
                                  name, [](const CLI::results_t&) { return true; }, help)
                              ->take_all()
                              ->each([&texts](const std::string& text) { texts.push_back(text); }));
}

CommandOption CommandOptions::add_read(const std::string& name, std::function<void(const std::string&)> take,
                                       const std::string& help) {
    return CommandOption(
        *app_->add_option_function<std::string>(name, refusing(name, std::move(take)), help));
}

CommandOption CommandOptions::add_read_list(const std::string& name,
                                            std::function<void(const std::vector<std::string>&)> take,
                                            const std::string& help) {
    return CommandOption(
        *app_->add_option_function<std::vector<std::string>>(name, refusing(name, std::move(take)), help));
}

std::optional<std::string> CommandOptions::parse_or_text(int argc, const char* const* argv) {
    try {
        std::vector<std::string> arguments = checked(argc, argv);
        prepare(*app_);
        if (app_->get_name().empty() && argc > 0) app_->name(argv[0]);
        app_->parse(std::move(arguments));
    } catch (const CLI::CallForHelp&) {
        return app_->help();
    } catch (const CLI::CallForVersion&) {
        return app_->version() + "\n";
    } catch (const CLI::ParseError& error) {
        throw std::invalid_argument(fmt::format("{}; see --help", error.what()));
    }
    return std::nullopt;
}

std::size_t CommandOptions::count(const std::string& name) const {
    return app_->count(name);
}

template CommandOption CommandOptions::add_option(const std::string&, std::string&, const std::string&);
template CommandOption CommandOptions::add_option(const std::string&, std::filesystem::path&,
                                                  const std::string&);
template CommandOption CommandOptions::add_option(const std::string&, int&, const std::string&);
template CommandOption CommandOptions::add_option(const std::string&, std::uint16_t&, const std::string&);
template CommandOption CommandOptions::add_option(const std::string&, double&, const std::string&);
template CommandOption CommandOptions::add_option(const std::string&, std::optional<std::string>&,
                                                  const std::string&);
template CommandOption CommandOptions::add_option(const std::string&, std::optional<std::filesystem::path>&,
                                                  const std::string&);
template CommandOption CommandOptions::add_option(const std::string&, std::optional<int>&,
                                                  const std::string&);
template CommandOption CommandOptions::add_option(const std::string&, std::optional<std::uint64_t>&,
                                                  const std::string&);
template CommandOption CommandOptions::add_option(const std::string&, std::optional<double>&,
                                                  const std::string&);

}  // namespace osteomill
