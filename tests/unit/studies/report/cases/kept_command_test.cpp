#include "analysis/output/cases/kept_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace osteomill::study {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;
using Words = std::vector<std::string>;

/// Two studies: one with a flag, a number, a list and a file of its own; one of nothing.
class KeptCommand : public ::testing::Test {
  protected:
    KeptCommand() {
        CLI::App* const fit = app_.add_subcommand("fit");
        fit->add_flag("--quick");
        fit->add_option("--seed", seed_);
        fit->add_option("--compare", pair_)->expected(2);
        fit->add_option("data", data_);
        for (CLI::App* const study : {fit, app_.add_subcommand("map")}) {
            add_out(*study, out_);
            add_parts(*study, parts_, 1);
            studies_.push_back({.subcommand = study, .run = {}});
        }
    }
    Words command(const Words& kept) const { return command_of_study(studies_, kept, "manifest.json"); }
    void expect_refused(const Words& kept, const std::string& why) const {
        EXPECT_THAT([&] { command(kept); },
                    ThrowsMessage<std::runtime_error>(
                        ::testing::AllOf(StartsWith("manifest.json: it names no study"), HasSubstr(why))))
            << ::testing::PrintToString(kept);
    }

  private:
    CLI::App app_;
    StudyParts parts_;
    std::filesystem::path out_ = "out";
    std::string data_;
    double seed_ = 0.0;
    std::vector<std::string> pair_;
    std::vector<StudyCommand> studies_;
};

TEST_F(KeptCommand, IsOfAStudyWithItsOptionsAndTheirValues) {
    for (const Words& kept : {Words{"map"}, Words{"fit", "runs.csv", "--quick", "--seed", "-3.5"},
                              Words{"fit", "--seed=2", "--compare", "a", "b", "--quick", "runs.csv"}})
        EXPECT_EQ(command(kept), kept);
}

TEST_F(KeptCommand, NamesNoSecondStudy) {
    expect_refused({"map", "fit", "runs.csv"}, "'fit' is a value of no option");
    expect_refused({"fit", "--quick", "runs.csv", "map"}, "'map' is a value of no option");
    expect_refused({"fit", "--seed", "1", "runs.csv", "map"}, "'map' is a value of no option");
}

TEST_F(KeptCommand, SaysNotWhereItIsWrittenNorHowItIsRun) {
    for (const char* const word : {"--out", "--out=x", "--merge", "--shard=1/2", "--jobs", "--database=x",
                                   "--help", "-h", "-o", "--unknown", "--", "--ou"})
        expect_refused({"map", word, "x"}, "is no option");
}

TEST_F(KeptCommand, IsOfNoOtherProgram) {
    expect_refused({}, "'' is none of the studies");
    expect_refused({"repeat", "x"}, "'repeat' is none of the studies");
    expect_refused({"--quick", "fit"}, "'--quick' is none of the studies");
}

}  // namespace
}  // namespace osteomill::study
