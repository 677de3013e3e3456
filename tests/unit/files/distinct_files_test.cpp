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

TEST_F(DistinctFiles, MayTakeThePlaceOfTheOneThatTheyContinue) {
    std::ofstream(folder_ / "a") << "old";
    const NamedFile bone{
        .option = "--bone", .path = folder_ / "a", .is_written = false, .is_replaced_by = "--save-bone"};
    const std::vector<NamedFile> saved{bone, {"--save-bone", folder_ / "a"}};
    EXPECT_NO_THROW(require_distinct(saved));
    const std::vector<NamedFile> recorded{bone, {"--record", folder_ / "a"}};
    EXPECT_THROW(require_distinct(recorded), std::invalid_argument);
}

TEST_F(DistinctFiles, AreRefusedInAFolderThatIsRead) {
    fs::create_directories(folder_ / "dicom/series");
    fs::create_symlink(folder_ / "dicom", folder_ / "link");
    std::ofstream(folder_ / "dicom/series/1.dcm") << "a slice";
    std::ofstream(folder_ / "elsewhere.dcm") << "a slice";
    fs::create_hard_link(folder_ / "dicom/series/1.dcm", folder_ / "second.dcm");
    fs::create_symlink("../elsewhere.dcm", folder_ / "dicom/2.dcm");
    for (const char* output :
         {"dicom/new.nrrd", "dicom/series/new.nrrd", "link/new.nrrd", "dicom/series/1.dcm",
          "link/series/1.dcm", "second.dcm", "elsewhere.dcm", "dicom/none/../new.nrrd"}) {
        const std::vector<NamedFile> files{{"INPUT", folder_ / "dicom", false}, {"OUT", folder_ / output}};
        EXPECT_THAT([&] { require_distinct(files); },
                    ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("OUT"), HasSubstr("INPUT"))))
            << output;
    }
    const std::vector<NamedFile> beside{{"INPUT", folder_ / "dicom", false}, {"OUT", folder_ / "new.nrrd"}};
    EXPECT_NO_THROW(require_distinct(beside));
}

TEST_F(DistinctFiles, AreRefusedUnderTheNamesThatAProgramChooses) {
    fs::create_directories(folder_ / "shots/left");
    std::ofstream(folder_ / "shots/frame_0001.png") << "a recording";
    fs::create_hard_link(folder_ / "shots/frame_0001.png", folder_ / "second.pcap");
    const std::vector<const char*> names{"frame_*.png", "left/*.npy"};
    const auto require = [&](const fs::path& read) {
        std::vector<NamedFile> files = files_written_in("--screenshots", folder_ / "shots", names);
        files.push_back({"--replay", read, false});
        require_distinct(files);
    };
    EXPECT_NO_THROW(require(folder_ / "shots/session.pcap"));
    EXPECT_NO_THROW(require(folder_ / "frame_0001.png"));
    for (const char* read : {"shots/frame_0001.png", "shots/left/1.npy", "second.pcap"})
        EXPECT_THAT([&] { require(folder_ / read); },
                    ThrowsMessage<std::invalid_argument>(HasSubstr("--screenshots and --replay")))
            << read;
}

TEST_F(DistinctFiles, AreRefusedWhereALinkLeadsToNothing) {
    fs::create_symlink("gone", folder_ / "dangling");
    EXPECT_THAT([&] { require(folder_ / "dangling", folder_ / "a.csv"); },
                ThrowsMessage<std::invalid_argument>(
                    AllOf(HasSubstr("--json"), HasSubstr("is a link to " + (folder_ / "gone").string()))));
    EXPECT_NO_THROW(require(folder_ / "a.json", folder_ / "dangling", true));
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
