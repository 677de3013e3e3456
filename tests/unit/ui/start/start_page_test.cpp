#include "render_client/ui/start/start_page.h"

#include <gmock/gmock.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <optional>
#include <thread>

#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

class StartPageTest : public ::testing::Test {
  protected:
    /// A program of that name that does what the script says.
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
    window.poll();
    EXPECT_FALSE(window.take_server()) << "it is there";
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
