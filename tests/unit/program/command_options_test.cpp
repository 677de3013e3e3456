#include "common/program/command_options.h"

#include <gmock/gmock.h>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace osteomill {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::optional<std::string> parse(CommandOptions& app, std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "program");
    return app.parse_or_text(static_cast<int>(arguments.size()), arguments.data());
}

/// Empty if the arguments are taken.
std::string why_refused(CommandOptions& app, const std::vector<const char*>& arguments) {
    try {
        parse(app, arguments);
    } catch (const std::invalid_argument& wrong) {
        return wrong.what();
    }
    return {};
}

TEST(CommandOptions, TakeNamesAsTheyStandWhereverTheyMayBe) {
    CommandOptions app("", "", "");
    std::string file, out;
    std::vector<std::string> parts, cuts;
    app.add_option("FILE", file, "").required();
    app.add_texts("--merge", parts, "");
    app.add_read_list(
        "--cut", [&](const std::vector<std::string>& texts) { cuts = texts; }, "");
    app.add_option("--out", out, "");
    parse(app, {"[a,b]", "--out=[x]", "--merge", "[e,f]", "--merge=[g]", "--merge", "c,d", "--cut", "[h,i]",
                "plain"});
    EXPECT_EQ(file, "[a,b]");
    EXPECT_EQ(out, "[x]");
    EXPECT_THAT(parts, ElementsAre("[e,f]", "[g]", "c,d"));
    EXPECT_THAT(cuts, ElementsAre("[h,i]", "plain"));
}

// CLI11 has them by address: in another order each time.
TEST(CommandOptions, HaveHelpThatNamesExclusionsInOrder) {
    CommandOptions app("What it does.", "program", "");
    std::vector<std::string> texts(6);
    const CommandOption dataset = app.add_option("--dataset", texts.back(), "").type_name("DIR");
    std::size_t at = 0;
    for (const char* other : {"--speed", "--renderer", "--look", "--cut", "--inset"})
        dataset.excludes(app.add_option(other, texts[at++], ""));
    EXPECT_THAT(parse(app, {"--help"}).value(),
                HasSubstr("--dataset DIR Excludes: --cut --inset --look --renderer --speed\n"));
}

TEST(CommandOptions, SayTheVersion) {
    CommandOptions app("", "", "program 1.2");
    EXPECT_EQ(parse(app, {"--version"}), "program 1.2\n");
}

// A script whose variable is not set gives such a value.
TEST(CommandOptions, RefuseAnEmptyValueWhereverItMayBe) {
    CommandOptions app("", "", "");
    std::string name, file;
    std::vector<std::string> texts;
    app.add_option("NAME", name, "");
    app.add_option("--file", file, "");
    app.add_texts("--group", texts, "help");
    for (const std::vector<const char*>& arguments :
         {std::vector{""}, {"--file", ""}, {"--file=", "x"}, {"--group", ""}})
        EXPECT_THROW(parse(app, arguments), std::invalid_argument);
}

TEST(CommandOptions, RefuseWhatIsNoPlainText) {
    CommandOptions app("", "", "");
    std::string name;
    app.add_option("NAME", name, "");
    for (const char* odd : {"a\nb", "\x1b[2J", "\xff"})
        EXPECT_THROW(parse(app, {odd}), std::invalid_argument) << odd;
}

TEST(CommandOptions, SayWhyAValueIsWrong) {
    CommandOptions app("", "", "");
    double number = 0.0;
    int port = 0;
    std::string colour;
    app.add_option("--above", number, "").check(above_zero());
    app.add_option("--port", port, "").check(whole_within(0, 65535));
    app.add_option("--colour", colour, "").check(one_of({"red", "blue"}));
    app.add_read(
        "--read", [](const std::string&) { throw std::invalid_argument("is no box"); }, "");
    for (const auto& [option, value, why] :
         {std::tuple("--above", "nan", "--above: nan is not above 0; see --help"),
          std::tuple("--above", "0", "--above: 0 is not above 0; see --help"),
          std::tuple("--above", "x", "--above: 'x' is no number; see --help"),
          std::tuple("--port", "70000", "--port: Value 70000 not in range 0 to 65535; see --help"),
          std::tuple("--colour", "green", "--colour: 'green' is not one of red, blue; see --help"),
          std::tuple("--read", "1,2", "--read: is no box; see --help")})
        EXPECT_EQ(why_refused(app, {option, value}), why);
}

TEST(CommandOptions, CountWhatWasGiven) {
    CommandOptions app("", "", "");
    bool is_on = false, has_panels = true;
    std::optional<bool> is_smooth;
    std::string name;
    const CommandOption option = app.add_option("--name", name, "");
    app.add_flag("--on", is_on, "");
    app.add_flag("!--no-panels", has_panels, "");
    app.add_switch(
        "--smooth,!--no-smooth", [&](bool smooth) { is_smooth = smooth; }, "");
    parse(app, {"--name", "x", "--no-panels", "--no-smooth"});
    EXPECT_EQ(option.count(), 1U);
    EXPECT_EQ(option.name(), "--name");
    EXPECT_EQ(app.count("--on"), 0U);
    EXPECT_FALSE(has_panels);
    EXPECT_EQ(is_smooth, false);
}

}  // namespace
}  // namespace osteomill
