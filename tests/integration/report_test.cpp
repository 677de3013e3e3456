// The report of a session: the live server's report equals the one recomputed from its recording.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/folder_test.h"

namespace osteomill::testing {
namespace {

using ::testing::HasSubstr;

class ReportProgram : public FolderTest {
  protected:
    Finished serve(std::vector<std::string> more) const {
        std::vector<std::string> command{HAPTIC_SERVER, "--clock", "virtual", "--duration-s", "4"};
        command.insert(command.end(), more.begin(), more.end());
        return run_program(command);
    }
};

TEST_F(ReportProgram, OfTheLiveSessionIsThatOfItsRecording) {
    std::ofstream(file("script.csv")) << "t_s,action,text\n3.0,mark,here\n";
    const Finished live = serve({"--trainee", "Anna", "--report", file("anna"), "--controls",
                                 file("script.csv"), "--json", file("server.json")});
    ASSERT_EQ(live.status, 0) << live.err;
    EXPECT_THAT(live.out, HasSubstr("the session has ended; its report is being made\nreport: "));
    const Finished again = run_program({PACKET_REPLAY, file("anna/session.pcap"), "--report", file("again")});
    ASSERT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(again.out, "report: " + file("again/report.html") + "\n");
    for (const std::string name : {"report.html", "metrics.csv", "metrics.json"}) {
        EXPECT_GT(text("anna/" + name).size(), 100u);
        EXPECT_EQ(text("anna/" + name), text("again/" + name)) << name;
    }
    const auto measured = nlohmann::json::parse(text("server.json"));
    const auto report = nlohmann::json::parse(text("anna/metrics.json"));
    EXPECT_EQ(report.at("session").at("trainee"), "Anna");
    EXPECT_EQ(report.at("session").at("bone_checksum"), measured.at("bone_checksum"));
    EXPECT_EQ(report.at("metrics").at("peak_force_n"), measured.at("peak_force_n"));
    EXPECT_NEAR(report.at("metrics").at("removed_mm3").get<double>(),
                measured.at("removed_mm3").at("total").get<double>(), 1e-9);
    EXPECT_EQ(report.at("session").at("settings").at("coupling"), measured.at("settings").at("coupling"));
    EXPECT_EQ(measured.at("settings").at("scene"), "tooth");
    EXPECT_EQ(measured.at("settings").at("milling_rate_hz"), 1000.0);
    EXPECT_FALSE(measured.contains("histograms_us"));
    EXPECT_TRUE(nlohmann::json::parse(text("server.histograms.json")).contains("milling_step"));

    const Finished second = serve({"--report", file("anna")});
    EXPECT_EQ(second.status, 1);
    EXPECT_THAT(second.err, HasSubstr("holds a session already (session.pcap); name another folder"));
}

TEST_F(ReportProgram, RefusesWhatCannotBe) {
    EXPECT_EQ(serve({"--report", file("a"), "--record", file("b.pcap")}).status, 2);
    EXPECT_EQ(serve({"--trainee", "two\nlines", "--report", file("a")}).status, 2);
    EXPECT_EQ(serve({"--trainee", "no UTF-8 \xff", "--report", file("a")}).status, 2);
    std::ofstream(file("taken")) << "a file";
    const Finished taken = serve({"--report", file("taken")});
    EXPECT_EQ(taken.status, 1);
    EXPECT_THAT(taken.err, HasSubstr("taken"));
    EXPECT_EQ(run_program({PACKET_REPLAY, file("nothing.pcap"), "--report", file("a")}).status, 1);
    EXPECT_EQ(
        run_program({PACKET_REPLAY, file("nothing.pcap"), "--report", file("a"), "--speed", "2"}).status, 2);
}

}  // namespace
}  // namespace osteomill::testing
