#include "render_client/ui/start/start_page.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>
#include <thread>

#include "common/words/translation.h"
#include "render_client/ui/panels/start_panel.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

class StartPageTest : public ::testing::Test {
  protected:
    /// A program of that name that runs the script.
    void make_program(const std::string& name, const std::string& script) {
        const auto file = folder_ / name;
        std::ofstream(file) << "#!/bin/sh\n" << script << "\n";
        std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    }
    StartPage page() { return StartPage({folder_.path(), folder_ / "home", {"127.0.0.1", 7010}}); }
    /// Polls until `happened`.
    static bool comes_true(StartPage& page, const std::function<bool()>& happened) {
        for (int i = 0; i < 3000; ++i) {
            page.poll();
            if (happened()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }
    /// Whether the page has made its preview of a scan.
    bool looks_at_a_scan(StartPage& page) const {
        const std::string scan = (folder_ / "scan.nrrd").string();
        std::ofstream(scan) << "x";
        page.show(StartPage::View::scan_browser);
        page.go_to(scan);
        return comes_true(page, [&] { return !page.is_working(); });
    }

    testing::TemporaryFolder folder_;
};

TEST_F(StartPageTest, SendsItsWindowToThePortThatTheServerWasGiven) {
    make_program("haptic_server", "echo \"$@\" > " + (folder_ / "arguments").string() +
                                      "\necho making ready >&2\necho listening on 127.0.0.1:43210\n"
                                      "trap 'exit 0' TERM\nwhile :; do sleep 0.01; done");
    StartPage window = page();
    EXPECT_FALSE(window.take_server());
    window.start();
    std::optional<ListenAddress> server;
    ASSERT_TRUE(comes_true(window, [&] { return (server = window.take_server()).has_value(); }))
        << window.message();
    EXPECT_EQ(server->port, 43210);
    EXPECT_TRUE(window.is_session_running());
    std::ifstream file(folder_ / "arguments");
    std::string arguments;
    std::getline(file, arguments);
    EXPECT_THAT(arguments, HasSubstr("--listen=127.0.0.1:0"));
    EXPECT_THAT(arguments, HasSubstr("--language=en")) << "the window's, for the report";
    EXPECT_THAT(arguments, HasSubstr("--wait-for-client")) << "its time runs once the bone is drawn";
    window.poll();
    EXPECT_FALSE(window.take_server()) << "it is there";
}

TEST_F(StartPageTest, HidesTheLastSessionWhileTheNextIsMadeReady) {
    make_program("haptic_server", "trap 'exit 0' TERM\nwhile :; do sleep 0.01; done");
    StartScreen screen({folder_.path(), folder_ / "home", {"127.0.0.1", 7010}});
    EXPECT_FALSE(screen.hides_session(LinkStatus::finished)) << "what was milled may be looked at";
    screen.page.start();
    ASSERT_TRUE(screen.page.is_making_ready());
    EXPECT_TRUE(screen.hides_session(LinkStatus::finished));
    EXPECT_TRUE(screen.hides_session(LinkStatus::connecting));
    EXPECT_FALSE(screen.stands_alone(LinkStatus::finished)) << "its server may take the window";
    EXPECT_TRUE(screen.hides_session(LinkStatus::live)) << "its bone is not drawn yet";
    screen.page.note_bone_of_session();
    EXPECT_TRUE(screen.page.is_beginning()) << "that was the one before: the window was not sent to it yet";
}

TEST_F(StartPageTest, HidesTheLastSessionUntilTheBoneOfTheNextIsDrawn) {
    make_program("haptic_server",
                 "echo listening on 127.0.0.1:43210\ntrap 'exit 0' TERM\nwhile :; do sleep 0.01; done");
    StartScreen screen({folder_.path(), folder_ / "home", {"127.0.0.1", 7010}});
    screen.page.start();
    ASSERT_TRUE(comes_true(screen.page, [&] { return screen.page.take_server().has_value(); }));
    EXPECT_TRUE(screen.hides_session(LinkStatus::connecting)) << "the window has not joined it yet";
    EXPECT_TRUE(screen.hides_session(LinkStatus::receiving_snapshot)) << "the bone is still the other one";
    screen.page.note_bone_of_session();
    EXPECT_FALSE(screen.page.is_beginning());
    EXPECT_FALSE(screen.hides_session(LinkStatus::live));
    EXPECT_FALSE(screen.hides_session(LinkStatus::finished)) << "what was milled may be looked at";
}

TEST_F(StartPageTest, SaysThatASessionIsMadeReadyThoughTheWindowStillSeesTheEndOfTheOneBefore) {
    make_program("haptic_server", "while [ ! -e " + (folder_ / "ready").string() +
                                      " ]; do sleep 0.01; done\necho listening on 127.0.0.1:43210\n"
                                      "trap 'exit 0' TERM\nwhile :; do sleep 0.01; done");
    StartPage window = page();
    window.start();
    window.note_end_of_session();
    EXPECT_THAT(window.message(), HasSubstr("is being made ready"));
    EXPECT_TRUE(window.is_making_ready());
    std::ofstream(folder_ / "ready") << "x";
    ASSERT_TRUE(comes_true(window, [&] { return window.take_server().has_value(); })) << window.message();
    EXPECT_FALSE(window.is_making_ready());
    window.note_end_of_session();
    EXPECT_THAT(window.message(), HasSubstr("its report is being written"));
}

TEST_F(StartPageTest, IsThereAfterASessionWasKilledUntilTheWindowIsSentToTheNext) {
    make_program("haptic_server", "echo listening on 127.0.0.1:43210\nkill -9 $$");
    StartScreen screen({folder_.path(), folder_ / "home", {"127.0.0.1", 7010}});
    screen.page.start();
    ASSERT_TRUE(comes_true(screen.page, [&] { return screen.page.has_served(); })) << screen.page.message();
    EXPECT_TRUE(screen.is_due(LinkStatus::lost));
    screen.page.is_hidden = true;
    EXPECT_FALSE(screen.is_due(LinkStatus::lost));
    EXPECT_TRUE(screen.is_hidden(LinkStatus::lost)) << "it can be brought back";
    EXPECT_FALSE(screen.is_hidden(LinkStatus::live)) << "there is another thing to do";

    make_program("haptic_server", "while :; do sleep 0.01; done");
    screen.page.start();
    screen.page.poll();
    EXPECT_TRUE(screen.is_due(LinkStatus::lost)) << "no session is there to be lost";
}

TEST_F(StartPageTest, SaysWhatToDoWhenTheDiskIsFullAtTheEnd) {
    make_program("haptic_server", "echo 'bone.nrrd: cannot be written: No space left on device' >&2\nexit 1");
    StartPage window = page();
    window.start();
    ASSERT_TRUE(comes_true(window, [&] { return !window.is_session_running(); }));
    EXPECT_THAT(window.message(), HasSubstr("No space left on device. Make room on the disk"));
    make_program("haptic_server", "echo 'there is no such case' >&2\nexit 1");
    window.start();
    ASSERT_TRUE(comes_true(window, [&] { return !window.is_session_running(); }));
    EXPECT_EQ(window.message(), "there is no such case");
}

TEST_F(StartPageTest, SaysInGermanThatTheDiskIsFull) {
    make_program("haptic_server",
                 "echo 'haptic_server: bone.nrrd: cannot be written: No space left on device' "
                 ">&2\nexit 1");
    speak("de");
    StartPage window = page();
    window.start();
    const bool ended = comes_true(window, [&] { return !window.is_session_running(); });
    speak("en");
    ASSERT_TRUE(ended);
    EXPECT_THAT(window.message(),
                ::testing::StartsWith("bone.nrrd: lässt sich nicht schreiben: die Platte ist "
                                      "voll. Auf der Platte Platz schaffen"));
}

TEST_F(StartPageTest, SaysToATraineeThatASessionWasBrokenOffAndWhatToDo) {
    make_program("haptic_server", "kill -9 $$");
    StartPage window = page();
    window.start();
    ASSERT_TRUE(comes_true(window, [&] { return !window.is_session_running(); }));
    EXPECT_THAT(window.message(), HasSubstr("broken off before anything was recorded. Start it anew"));
    make_program("haptic_server",
                 "for a; do case $a in --report=*) d=${a#--report=};; esac; done\n"
                 "mkdir -p $d; echo x > $d/session.part.pcap; kill -9 $$");
    window.trainee = "Eva";
    window.start();
    ASSERT_TRUE(comes_true(window, [&] { return !window.is_session_running(); }));
    EXPECT_THAT(window.message(), HasSubstr("\"Make report\" makes its report"));
    EXPECT_THAT(window.message(), ::testing::Not(HasSubstr("signal")));
}

TEST_F(StartPageTest, StartsBesideAReportThatIsStillBeingWrittenAndSaysSo) {
    const std::string ended = (folder_ / "ended").string();
    const std::string written = (folder_ / "written").string();
    make_program("haptic_server", "while [ ! -e " + ended +
                                      " ]; do sleep 0.01; done\n"
                                      "echo 'the session has ended; its report is being made'\n"
                                      "trap '' TERM\nwhile [ ! -e " +
                                      written + " ]; do sleep 0.01; done");
    StartPage window = page();
    EXPECT_EQ(window.why_not_start(), "");
    window.start();
    EXPECT_FALSE(window.may_start());
    EXPECT_EQ(window.why_not_start(), "a session is being made ready");
    std::ofstream{ended};
    ASSERT_TRUE(comes_true(window, [&] { return window.may_start(); }));
    EXPECT_EQ(window.why_not_start(), "the last session's report is still being written");
    make_program("haptic_server", "trap 'exit 0' TERM\nwhile :; do sleep 0.01; done");
    window.start();
    EXPECT_TRUE(window.is_session_running());
    EXPECT_FALSE(window.may_start());
    std::ofstream{written};
}

TEST_F(StartPageTest, StartsACaseAtTheSecondClickOnItsCardHoweverLateAndNoOther) {
    make_program("haptic_server", "while :; do sleep 0.01; done");
    StartPage window = page();
    window.click_card(0);
    EXPECT_FALSE(window.is_session_running()) << "it is chosen from the start, but nobody has clicked on it";
    window.click_card(1);
    EXPECT_FALSE(window.is_session_running());
    window.show(StartPage::View::cases);
    window.click_card(1);
    EXPECT_FALSE(window.is_session_running()) << "the cards may be others now";
    window.click_card(1);
    EXPECT_TRUE(window.is_session_running());
    EXPECT_EQ(window.chosen, 1U);
    EXPECT_THAT(window.message(), HasSubstr(window.cases()[1].name));
}

TEST_F(StartPageTest, CountsTheFirstClickOnACardWhileTheLastSessionIsSaved) {
    make_program("haptic_server", "while [ ! -e " + (folder_ / "saved").string() + " ]; do sleep 0.01; done");
    StartPage window = page();
    window.start();
    ASSERT_FALSE(window.may_start());
    window.click_card(1);
    std::ofstream(folder_ / "saved") << "";
    ASSERT_TRUE(comes_true(window, [&] { return window.may_start(); }));
    std::filesystem::remove(folder_ / "saved");
    window.click_card(1);
    EXPECT_TRUE(window.is_session_running());
}

TEST_F(StartPageTest, SaysInTheWindowsLanguageHowFarAReportIs) {
    const auto session = folder_ / "home" / "reports" / "jaw-anna-20261128-140500";
    std::filesystem::create_directories(session);
    std::ofstream(session / "session.pcap") << "x";
    make_program("packet_replay", "echo 'refining 40 %, 12 s left'\nwhile [ ! -e " +
                                      (folder_ / "on").string() + " ]; do sleep 0.01; done");
    speak("de");
    StartPage window = page();
    window.open_report_of(window.sessions().at(0));
    EXPECT_TRUE(comes_true(window, [&] { return window.message() == "wird feiner 40 %, noch 12 s"; }))
        << window.message();
    speak("en");
    std::ofstream(folder_ / "on") << "";
}

TEST_F(StartPageTest, BreaksOffASessionWhoseProgramStandsStill) {
    make_program("haptic_server", "trap '' TERM INT\nwhile :; do sleep 0.01; done");
    StartPage window = page();
    window.start();
    ASSERT_TRUE(window.is_session_running());
    window.break_off();
    ASSERT_TRUE(comes_true(window, [&] { return !window.is_session_running(); }));
    EXPECT_EQ(window.message(),
              "The session was broken off here, as you asked, before anything was recorded.");
}

TEST_F(StartPageTest, ComparesInTheWindowsLanguageWhatWasFinished) {
    make_program("osteomill_study", "echo \"$@\" > " + (folder_ / "arguments").string());
    const auto session = folder_ / "home" / "reports" / "jaw-anna-20261128-140500";
    std::filesystem::create_directories(session);
    std::ofstream(session / "session.part.pcap") << "x";
    StartPage window = page();
    window.compare_sessions();
    EXPECT_THAT(window.message(), HasSubstr("no session was finished"));
    const auto broken_off = folder_ / "home" / "reports" / "jaw-eva-20261128-150500";
    std::filesystem::create_directories(broken_off);
    std::ofstream(broken_off / "session.part.pcap") << "x";
    std::filesystem::rename(session / "session.part.pcap", session / "session.pcap");
    window.compare_sessions();
    ASSERT_TRUE(comes_true(window, [&] { return !window.is_working(); }));
    std::string arguments;
    std::ifstream file(folder_ / "arguments");
    std::getline(file, arguments);
    EXPECT_THAT(arguments, HasSubstr("sessions --out"));
    EXPECT_THAT(arguments, HasSubstr("--language=en"));
    EXPECT_THAT(arguments, HasSubstr(session.string()));
    EXPECT_THAT(arguments, HasSubstr(broken_off.string())) << "the page names it";
}

TEST_F(StartPageTest, ReplaysInAWindowAsLargeAsItsOwn) {
    make_program("render_client", "echo \"$@\" > " + (folder_ / "arguments").string());
    StartPage window = page();
    window.window_size = {800, 600};
    window.replay(folder_ / "session.pcap");
    std::string arguments;
    ASSERT_TRUE(comes_true(window, [&] {
        std::ifstream file(folder_ / "arguments");
        return static_cast<bool>(std::getline(file, arguments));
    })) << window.message();
    EXPECT_THAT(arguments, HasSubstr("--replay=" + (folder_ / "session.pcap").string()));
    EXPECT_THAT(arguments, HasSubstr("--window-size=800x600"));
}

TEST_F(StartPageTest, LooksAtAScanOnceAndGoesThroughItsSlices) {
    make_program("bone_import", "echo \"$@\" >> " + (folder_ / "arguments").string() +
                                    "\nfor last; do :; done\nprintf 12345678 > \"$last\"\n"
                                    "echo covers 0,0,0,0.5,0.5,0.5\necho HU from -1000 to 2000");
    std::ofstream(folder_ / "scan.nrrd") << "x";
    StartPage window = page();
    window.show(StartPage::View::scan_browser);
    window.go_to((folder_ / "none").string());
    EXPECT_THAT(window.message(), HasSubstr("none: is not there"));
    EXPECT_EQ(window.path(), (folder_ / "none").string()) << "to be mended, not to be written anew";
    window.go_to(folder_.path().string());
    EXPECT_EQ(window.listing().folder, folder_.path());
    EXPECT_EQ(window.path(), folder_.path().string());
    window.go_to((folder_ / "scan.nrrd").string());
    EXPECT_EQ(window.view(), StartPage::View::import);
    ASSERT_TRUE(comes_true(window, [&] { return !window.is_working(); }));
    ASSERT_TRUE(window.voxels()) << window.message();
    EXPECT_EQ(window.voxels()->greys.back(), '8');
    EXPECT_EQ(window.slices_at_mm, glm::dvec3(0.25));
    EXPECT_GT(window.look()->took_s, 0.0);
    ASSERT_TRUE(comes_true(window, [&] { return window.loose_parts().has_value(); }));
    window.form.threshold_hu += 1.0;
    EXPECT_FALSE(window.loose_parts()) << "that was of another threshold";
    std::ifstream file(folder_ / "arguments");
    std::string once, again;
    EXPECT_TRUE(std::getline(file, once));
    EXPECT_FALSE(std::getline(file, again)) << again;
}

TEST_F(StartPageTest, SaysAtOnceThatAThresholdIsNoneOfTheScansAndDropsAnErrorOnceTheFormChanges) {
    make_program("bone_import",
                 "case \"$*\" in *--case*) echo 'scan.nrrd: no voxel reaches --threshold-hu 301'; "
                 "exit 1;; esac\nfor last; do :; done\nprintf 12345678 > \"$last\"\n"
                 "echo covers 0,0,0,0.5,0.5,0.5\necho HU from -1000 to 2000");
    StartPage window = page();
    ASSERT_TRUE(looks_at_a_scan(window));
    window.form.threshold_hu = 9000.0;
    window.import();
    EXPECT_FALSE(window.is_working()) << "the scan need not be read for that";
    EXPECT_THAT(
        window.message(),
        HasSubstr("the HU threshold is 9000, and nothing of the scan is bone: choose one of at most 3071"));
    window.form.threshold_hu = 301.0;
    window.poll();
    EXPECT_EQ(window.message(), "");
    window.import();
    ASSERT_TRUE(comes_true(window, [&] { return !window.is_working(); }));
    EXPECT_THAT(window.message(), HasSubstr("no voxel reaches HU threshold 301"));
    window.poll();
    EXPECT_NE(window.message(), "") << "nothing was changed";
    window.form.threshold_hu = 302.0;
    window.poll();
    EXPECT_EQ(window.message(), "");
}

TEST_F(StartPageTest, ShowsNoTemporaryFileWhileItLooksAtAScan) {
    const std::string said = (folder_ / "said").string(), on = (folder_ / "on").string();
    make_program("bone_import", "for last; do :; done\necho \"bone_import: preview: $last\"\ntouch " + said +
                                    "\nwhile [ ! -e " + on + " ]; do sleep 0.01; done");
    std::ofstream(folder_ / "scan.nrrd") << "x";
    StartPage window = page();
    window.show(StartPage::View::scan_browser);
    window.go_to((folder_ / "scan.nrrd").string());
    ASSERT_TRUE(comes_true(window, [&] { return std::filesystem::exists(said); }));
    window.poll();
    EXPECT_EQ(window.message(), "looking at the scan ...");
    std::ofstream(on) << "";
}

TEST_F(StartPageTest, NamesTheReportAndSaysWhetherABrowserCouldBeOpened) {
    const auto session = folder_ / "home" / "reports" / "jaw-anna-20261128-140500";
    std::filesystem::create_directories(session);
    std::ofstream(session / "session.pcap") << "x";
    std::ofstream(session / "report.html") << "x";
    // Nothing is found in an empty PATH, so that no browser of this machine opens.
    const char* const path = std::getenv("PATH");
    const std::string before = path != nullptr ? path : "";
    ::setenv("PATH", folder_.path().c_str(), 1);
    StartPage window = page();
    window.open_report_of(window.sessions().at(0));
    const std::string file = (session / "report.html").string();
    const bool is_said =
        comes_true(window, [&] { return window.message() == "No browser could be opened: " + file; });
    ::setenv("PATH", before.c_str(), 1);
    EXPECT_TRUE(is_said) << window.message();
}

TEST_F(StartPageTest, GoesBackToWhereAPageWasCalled) {
    StartPage window = page();
    window.show(StartPage::View::recording_browser);
    window.go_back();
    EXPECT_TRUE(window.shows_cases());
    window.show(StartPage::View::segmentation_browser);
    window.go_back();
    EXPECT_EQ(window.view(), StartPage::View::import);
    window.go_back();
    EXPECT_EQ(window.view(), StartPage::View::scan_browser) << "no scan has been looked at";
    window.go_back();
    EXPECT_TRUE(window.shows_cases());
}

TEST_F(StartPageTest, ChoosesTheCaseThatItImportedAndBringsItIntoSight) {
    const auto made = folder_ / "home" / "cases" / "scan";
    make_program("bone_import", "case \"$*\" in *--case*) mkdir -p " + made.string() + "; touch " +
                                    (made / "case.toml").string() +
                                    "; exit;; esac\nfor last; do :; done\nprintf 12345678 > \"$last\"\n"
                                    "echo covers 0,0,0,0.5,0.5,0.5\necho HU from -1000 to 2000");
    StartPage window = page();
    ASSERT_TRUE(looks_at_a_scan(window));
    EXPECT_FALSE(window.scrolls_to_chosen);
    window.import();
    ASSERT_TRUE(comes_true(window, [&] { return !window.is_working(); }));
    EXPECT_EQ(window.view(), StartPage::View::cases) << window.message();
    EXPECT_EQ(window.cases()[window.chosen].name, "scan");
    EXPECT_TRUE(window.scrolls_to_chosen);
}

TEST_F(StartPageTest, OffersTheFilesThatMayBeMeant) {
    for (const char* name : {"session.pcap", "IM0001", "names.ctbl"}) std::ofstream(folder_ / name) << "x";
    StartPage window = page();
    window.show(StartPage::View::scan_browser);
    window.browse(folder_.path());
    EXPECT_EQ(window.listing().files.size(), 3U) << "DICOM has any name";
    window.show(StartPage::View::recording_browser);
    EXPECT_EQ(window.listing().files, std::vector<std::string>{"session.pcap"});
    window.show(StartPage::View::colours_browser);
    EXPECT_EQ(window.listing().files, std::vector<std::string>{"names.ctbl"});
}

TEST_F(StartPageTest, GoesBackToTheWindowsOwnServerWhenTheSessionIsOver) {
    make_program("haptic_server", "echo listening on 127.0.0.1:43210");
    StartPage window = page();
    window.start();
    ASSERT_TRUE(comes_true(window, [&] { return !window.is_session_running(); }));
    const auto server = window.take_server();
    ASSERT_TRUE(server);
    EXPECT_EQ(server->port, 7010);
}

}  // namespace
}  // namespace osteomill
