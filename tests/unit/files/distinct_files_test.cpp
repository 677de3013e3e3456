#include "common/files/distinct_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using ::testing::ThrowsMessage;

class DistinctFiles : public ::testing::Test {
  protected:
    static void require(const fs::path& json, const fs::path& csv, bool reads_csv = false) {
        const std::vector<NamedFile> files{
            {"--record", "/elsewhere/a.pcap"}, {"--json", json}, {"--csv", csv, !reads_csv}};
        require_distinct(files);
    }
    static void expect_refused(const fs::path& json, const fs::path& csv, bool reads_csv = false) {
        EXPECT_THAT([&] { require(json, csv, reads_csv); },
                    ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("--json"), HasSubstr("--csv"))))
            << json << " " << csv;
    }

    TemporaryFolder folder_;
};

TEST_F(DistinctFiles, MayLieBesideEachOther) {
    EXPECT_NO_THROW(require(folder_ / "a.json", folder_ / "a.csv"));
    EXPECT_NO_THROW(require("a.json", "a.csv"));
}

TEST_F(DistinctFiles, AreRefusedWhereTheyAreOneThatIsNotThereYet) {
    expect_refused(folder_ / "a", folder_ / "a");
    expect_refused(folder_ / "a", folder_ / "./none/../a");
    expect_refused("a", "./a");
    expect_refused("a", fs::current_path() / "a");
}

TEST_F(DistinctFiles, AreRefusedWhereLinksLeadToOne) {
    std::ofstream(folder_ / "a") << "old";
    fs::create_symlink("a", folder_ / "soft");
    fs::create_hard_link(folder_ / "a", folder_ / "hard");
    fs::create_symlink(folder_.path(), folder_ / "same");
    fs::create_symlink("later", folder_ / "dangling");
    expect_refused(folder_ / "a", folder_ / "soft");
    expect_refused(folder_ / "a", folder_ / "hard");
    expect_refused(folder_ / "soft", folder_ / "hard");
    expect_refused(folder_ / "new", folder_ / "same" / "new");
    expect_refused(folder_ / "later", folder_ / "dangling");
}

TEST_F(DistinctFiles, AreRefusedWhereOneIsRead) {
    std::ofstream(folder_ / "a") << "old";
    expect_refused(folder_ / "a", folder_ / "a", true);
    const std::vector<NamedFile> read{{"--one", folder_ / "a", false}, {"--other", folder_ / "a", false}};
    EXPECT_NO_THROW(require_distinct(read));
}

TEST_F(DistinctFiles, AreRefusedWhereOneIsThePartOfTheOther) {
    expect_refused(folder_ / "a.csv", folder_ / "a.part.csv");
    expect_refused(folder_ / "a.part.csv", folder_ / "a.csv");
}

TEST_F(DistinctFiles, MayAllBeADevice) {
    EXPECT_NO_THROW(require("/dev/null", "/dev/null"));
}

}  // namespace
}  // namespace osteomill
