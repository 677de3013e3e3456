#include "render_client/ui/start/case_library.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <fstream>

#include "render_client/volume/picture.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(CaseLibrary, HasTheBuiltInCasesAndWhatWasImported) {
    const testing::TemporaryFolder folder;
    for (const char* name : {"zygoma", "a jaw", "no case"})
        std::filesystem::create_directories(folder / name);
    std::ofstream(folder / "zygoma/case.toml") << "name = \"z\"\n";
    std::ofstream(folder / "a jaw/case.toml") << "name = \"j\"\ndescription = \"An imported "
                                                 "jaw\"\n[bone]\nphantom = \"cube\"\n[[tissues]]\nlabel = 1\n"
                                                 "name = \"nerve\"\ncolour = \"#ffffff\"\nprotected = true\n";
    std::ofstream(folder / "a file") << "nothing";
    const auto cases = cases_in(folder / ".");
    ASSERT_EQ(cases.size(), 7U);
    EXPECT_EQ(cases[0].name, "jaw");
    EXPECT_EQ(cases[1].name, "mastoid");
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_TRUE(cases[i].is_built_in);
        EXPECT_EQ(cases[i].argument, cases[i].name);
        EXPECT_FALSE(cases[i].description.empty()) << cases[i].name;
    }
    EXPECT_EQ(cases[0].protected_names, "pulp, nerve canal");
    EXPECT_THAT(cases[1].protected_names, AllOf(HasSubstr("Facial Nerve"), HasSubstr("Sinus + Dura")));
    EXPECT_EQ(cases[5].name, "a jaw");
    EXPECT_EQ(cases[5].description, "An imported jaw");
    EXPECT_EQ(cases[5].protected_names, "nerve");
    EXPECT_EQ(std::filesystem::path(cases[6].argument), folder / "./zygoma");
    EXPECT_THAT(cases[6].description, HasSubstr("'bone'")) << "what is wrong with it";
    EXPECT_EQ(cases_in(folder / "not there").size(), 5U);
}

TEST(CaseLibrary, SaysWhatASessionMustReachToPass) {
    const auto cases = cases_in("nowhere");
    EXPECT_EQ(cases[1].marks,
              "at most 30 min, at least 80 % of the target removed, at most 200 mm³ beside the "
              "target, nothing touched that is protected, at most 5 N");
    EXPECT_EQ(std::ranges::find(cases, "cube", &ShelvedCase::name)->marks, "");
    EXPECT_EQ(marks_in_words({{"time_s", 90.0}, {"structure_touches", 2.0}, {"rating_share", 0.75}}),
              "at least 75 % of the points, at most 90 s, at most 2 touches of what is protected");
    for (const PassMarkKind& kind : pass_mark_kinds)
        EXPECT_NE(marks_in_words({{kind.metric, kind.low}}), "") << kind.metric;
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

TEST(CaseLibrary, HasAPictureOfEveryBuiltInCase) {
    for (const ShelvedCase& shelved : cases_in("nowhere")) {
        const auto picture = std::ranges::find(case_pictures(), shelved.name, &CasePicture::name);
        ASSERT_NE(picture, case_pictures().end()) << shelved.name;
        EXPECT_EQ(read_png(picture->png).size_px, glm::ivec2(240, 160)) << shelved.name;
    }
    EXPECT_THROW((void)read_png(std::span<const std::uint8_t>()), std::runtime_error);
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
    EXPECT_THAT(line, HasSubstr("can name another folder"));
    EXPECT_EQ(line.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace osteomill
