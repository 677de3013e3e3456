// Options of a program's command line, read by CLI11, which only command_options.cpp sees: its header takes
// the compiler 4 s in every object.
//
// Four ways of CLI11 are corrected: error messages name no unreachable limit, NaN is refused, a choice is
// shown without C++ containers, and help is the same text each time. And an empty value is refused: a
// variable of a script that was not set must not be the default.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace osteomill {

/// A condition that a value must meet.
struct OptionCheck {
    std::function<std::string(const std::string& value)> why_wrong;  ///< empty if it is right
    std::string description;                                         ///< for the help
};

OptionCheck one_of(const std::vector<std::string>& names);
OptionCheck above_zero();
OptionCheck not_below_zero();
/// Both ends are right.
OptionCheck within(double low, double high);
OptionCheck whole_within(int low, int high);

/// An option of CommandOptions, which outlives it. What is set is returned with it, to go on.
class CommandOption {
  public:
    explicit CommandOption(CLI::Option& option) : option_(&option) {}

    /// The name of its value in the help.
    CommandOption type_name(const std::string& name) const;
    CommandOption required() const;
    CommandOption check(const OptionCheck& check) const;
    /// The help says the value that the variable has now.
    CommandOption shows_default() const;
    CommandOption excludes(const std::string& other) const;
    CommandOption excludes(CommandOption other) const;
    CommandOption needs(CommandOption other) const;
    /// A further line of its help.
    CommandOption add_help(const std::string& line) const;

    /// After parsing: how many times it was given.
    std::size_t count() const;
    std::string name() const;

  private:
    CLI::Option* option_;
};

class CommandOptions {
  public:
    /// `version`: the text that --version prints.
    CommandOptions(const std::string& description, const std::string& program, const std::string& version);
    ~CommandOptions();
    CommandOptions(const CommandOptions&) = delete;
    CommandOptions& operator=(const CommandOptions&) = delete;

    // Variables and functions outlive the parsing, which sets and calls them.

    /// `Value`: one of those at the end of command_options.cpp.
    template <typename Value>
    CommandOption add_option(const std::string& name, Value& value, const std::string& help);
    /// "--name" sets true; "!--name" false.
    CommandOption add_flag(const std::string& name, bool& value, const std::string& help);
    /// "--name,!--other": called with true if the first is given, with false if the other is.
    CommandOption add_switch(const std::string& names, std::function<void(bool)> take,
                             const std::string& help);
    /// An option that takes its text as typed, once for each time it is given: "[a,b]", "{}" and "-x" are
    /// names, where CLI11 would read lists, nothing and an option.
    CommandOption add_texts(const std::string& name, std::vector<std::string>& texts,
                            const std::string& help);
    /// An option whose text `take` reads. `take` refuses a value with std::invalid_argument, whose message
    /// continues a line that begins with the option's name.
    CommandOption add_read(const std::string& name, std::function<void(const std::string&)> take,
                           const std::string& help);
    /// The same of several texts, which are read at once.
    CommandOption add_read_list(const std::string& name,
                                std::function<void(const std::vector<std::string>&)> take,
                                const std::string& help);

    /// Fills in what was added; returns the text if help or the version is requested. It refuses arguments
    /// that are no plain text (foreign_text.h), because they name files and people, and such names go into
    /// logs, reports and recordings. And it takes "[a,b]" for a name. Throws std::invalid_argument with one
    /// line for wrong usage.
    std::optional<std::string> parse_or_text(int argc, const char* const* argv);

    /// After parsing: how many times the option of this name was given.
    std::size_t count(const std::string& name) const;

  private:
    std::unique_ptr<CLI::App> app_;
};

}  // namespace osteomill
