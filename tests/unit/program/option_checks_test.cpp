#include "common/program/option_checks.h"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace osteomill {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(ParseArguments, TakesNamesAsTheyStandWhereverTheyMayBe) {
    CLI::App app;
    std::vector<std::filesystem::path> folders, parts;
    std::string out;
    CLI::App* sub = app.add_subcommand("join");
    sub->add_option("DIR", folders)->required();
    sub->add_option("--merge", parts)->expected(1, -1);
    sub->add_option("--out", out);
    const char* arguments[] = {"program", "join",  "[a,b]",       "c,d",  "--out=[x]",
                               "--merge", "[e,f]", "--merge=[g]", "plain"};
    parse_arguments(app, static_cast<int>(std::size(arguments)), arguments);
    EXPECT_THAT(folders, ElementsAre("[a,b]", "c,d"));
    EXPECT_THAT(parts, ElementsAre("[e,f]", "[g]", "plain"));
    EXPECT_EQ(out, "[x]");
}

// CLI11 has them by address: in another order each time.
TEST(ParseArguments, LeavesHelpThatNamesExclusionsInOrder) {
    CLI::App app;
    CLI::App* sub = app.add_subcommand("join");
    CLI::Option* dataset = sub->add_option("--dataset")->type_name("DIR");
    for (const char* other : {"--speed", "--renderer", "--look", "--cut", "--inset"})
        dataset->excludes(sub->add_option(other));
    const char* arguments[] = {"program", "join"};
    parse_arguments(app, 2, arguments);
    EXPECT_THAT(sub->help(), HasSubstr("--dataset DIR Excludes: --cut --inset --look --renderer --speed\n"));
}

// A script whose variable is not set gives such a value.
TEST(ParseArguments, RefusesAnEmptyValueWhereverItMayBe) {
    CLI::App app;
    std::string name, file;
    std::vector<std::string> texts;
    app.add_option("NAME", name);
    app.add_option("--file", file);
    add_texts(app, "--group", texts, "help");
    for (const std::vector<const char*>& arguments : {std::vector{"program", ""},
                                                      {"program", "--file", ""},
                                                      {"program", "--file=", "x"},
                                                      {"program", "--group", ""}})
        EXPECT_THROW(parse_arguments(app, static_cast<int>(arguments.size()), arguments.data()),
                     CLI::ParseError);
}

TEST(ParseArguments, RefusesWhatIsNoPlainText) {
    CLI::App app;
    std::string name;
    app.add_option("NAME", name);
    for (const char* odd : {"a\nb", "\x1b[2J", "\xff"}) {
        const char* arguments[] = {"program", odd};
        EXPECT_THROW(parse_arguments(app, 2, arguments), CLI::ParseError) << odd;
    }
}

}  // namespace
}  // namespace osteomill
