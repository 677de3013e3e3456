#include "render_client/ui/start/case_library.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

TEST(CaseLibrary, HasTheBuiltInCasesAndWhatWasImported) {
    const testing::TemporaryFolder folder;
    for (const char* name : {"zygoma", "a jaw", "no case"})
        std::filesystem::create_directories(folder / name);
    std::ofstream(folder / "zygoma/case.toml") << "name = \"z\"\n";
    std::ofstream(folder / "a jaw/case.toml") << "name = \"j\"\n";
    std::ofstream(folder / "a file") << "nothing";
    const auto cases = cases_in(folder / ".");
    ASSERT_EQ(cases.size(), 5U);
    EXPECT_EQ(cases[0], (ShelvedCase{"tooth", "tooth"}));
    EXPECT_EQ(cases[3].name, "a jaw");
    EXPECT_EQ(std::filesystem::path(cases[4].argument), folder / "./zygoma");
    EXPECT_EQ(cases_in(folder / "not there").size(), 3U);
}

TEST(CaseLibrary, RefusesNamesThatWouldBeNoFolderOrAreTaken) {
    const testing::TemporaryFolder folder;
    std::filesystem::create_directories(folder / "taken");
    for (const char* good : {"jaw of A-1_b.2", "Kieferknochen für Übung", "下颌骨"})
        EXPECT_EQ(wrong_with_name(good, folder / "."), "");
    for (const char* bad : {"", ".hidden", "a/b", "..", " blank", "blank ", "new\nline", "Z\xe4hne"})
        EXPECT_THAT(wrong_with_name(bad, folder / "."), HasSubstr("characters")) << bad;
    EXPECT_THAT(wrong_with_name(std::string(61, 'x'), folder / "."), HasSubstr("60"));
    EXPECT_THAT(wrong_with_name("taken", folder / "."), HasSubstr("already"));
    EXPECT_THAT(wrong_with_name("tooth", folder / "."), HasSubstr("built in"));
}

TEST(CaseLibrary, KnowsTheSessionsThatWereRecorded) {
    const testing::TemporaryFolder folder;
    for (const char* name : {"b", "a", "torn"}) std::filesystem::create_directories(folder / name);
    for (const char* file : {"a/session.pcap", "b/session.pcap", "torn/session.part.pcap"})
        std::ofstream(folder / file) << "x";
    const auto sessions = sessions_in(folder / ".");
    ASSERT_EQ(sessions.size(), 2U);
    EXPECT_EQ(sessions[0].filename(), "a");
    EXPECT_TRUE(sessions_in(folder / "nowhere").empty());
}

TEST(CaseLibrary, NamesAReportByCaseTraineeAndTime) {
    ::setenv("TZ", "UTC", 1);
    EXPECT_EQ(report_folder("/r", "a jaw", "Anna O'Hara/../x", 0),
              "/r/a jaw-Anna O'Hara_.._x-19700101-000000");
    EXPECT_EQ(report_folder("/r", "Zähne", "Jürgen Öz", 0), "/r/Zähne-Jürgen Öz-19700101-000000");
    EXPECT_EQ(report_folder("/r", "tooth", "", 86400), "/r/tooth-nobody-19700102-000000");
}

TEST(CaseLibrary, SaysInOneLineThatNothingCanBeKeptAndWhatToDo) {
    const testing::TemporaryFolder folder;
    EXPECT_EQ(make_folder_at_home(folder / "home/reports"), "");
    EXPECT_TRUE(std::filesystem::is_directory(folder / "home/reports"));
    std::ofstream(folder / "file") << "x";
    const std::string line = make_folder_at_home(folder / "file/reports");
    EXPECT_THAT(line, HasSubstr("--home DIR"));
    EXPECT_EQ(line.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace osteomill
