// --metrics and --log-json of the real server: a session on the real clock is asked over a socket while it
// runs.
#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/support/child_process.h"
#include "tests/support/scraped_metrics.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::testing {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using ::testing::HasSubstr;

TEST(Metrics, AreOfTheSessionThatRuns) {
    ChildProcess server(
        {HAPTIC_SERVER, "--case", "cube", "--listen", "127.0.0.1:0", "--metrics", "127.0.0.1:0"});
    const std::string metrics = server.line_after("metrics on 127.0.0.1:").value_or("");
    const std::string port = server.line_after("listening on 127.0.0.1:").value_or("");
    ASSERT_FALSE(metrics.empty() || port.empty()) << server.err();
    std::map<std::string, double> values;
    ASSERT_TRUE(eventually([&] { return (values = scraped(metrics))["osteomill_ticks_total"] > 100.0; }));
    EXPECT_EQ(values.at("osteomill_clients"), 0.0);
    EXPECT_EQ(values.at("osteomill_sent_bytes_total"), 0.0);
    EXPECT_EQ(values.count("osteomill_faults_total{fault=\"overrun\"}"), 1U);
    EXPECT_EQ(values.at("osteomill_tick_latency_seconds_bucket{le=\"+Inf\"}"),
              values.at("osteomill_tick_latency_seconds_count"));
    EXPECT_GT(values.at("osteomill_tick_latency_seconds_count"), 0.0);

    asio::io_context io;
    std::optional<tcp::socket> client = connected(io, port);
    EXPECT_TRUE(eventually([&] {
        values = scraped(metrics);
        return values.at("osteomill_clients") == 1.0 && values.at("osteomill_sent_bytes_total") > 0.0;
    })) << "the hello was sent to it";
    client.reset();
    EXPECT_TRUE(eventually([&] { return scraped(metrics).at("osteomill_clients") == 0.0; }));

    server.send_signal(SIGTERM);
    EXPECT_EQ(server.wait(), 0) << server.err();
}

TEST(Metrics, AreRefusedWhereOthersCouldAsk) {
    for (const char* address : {"0.0.0.0:9464", "[::]:9464", "192.0.2.1:0"}) {
        const Finished refused = run_program({HAPTIC_SERVER, "--metrics", address});
        EXPECT_EQ(refused.status, 2);
        EXPECT_THAT(refused.err,
                    HasSubstr("--metrics: '" + std::string(address) + "' can be reached from elsewhere"));
    }
}

TEST(LogJson, IsAnObjectALineAlsoForTheStatusAndTheError) {
    const TemporaryFolder folder;
    const std::filesystem::path full = folder / "a \"b\".nrrd";
    std::filesystem::create_symlink("/dev/full", full);
    const Finished run =
        run_program({HAPTIC_SERVER, "--case", "cube", "--clock", "virtual", "--duration-s", "0.2", "--listen",
                     "127.0.0.1:0", "--log-json", "--save-bone", full.string()});
    EXPECT_EQ(run.status, 1);
    std::istringstream lines(run.err);
    std::map<std::string, int> levels;
    std::string all;
    for (std::string line; std::getline(lines, line);) {
        const nlohmann::json object = nlohmann::json::parse(line, nullptr, false);
        ASSERT_TRUE(object.is_object() && object.size() == 3) << line;
        EXPECT_THAT(object.at("time"), ::testing::MatchesRegex("20..-..-..T..:..:..\\....Z"));
        ++levels[object.at("level")];
        all += object.at("message").get<std::string>() + "\n";
    }
    EXPECT_THAT(all, HasSubstr("spindle"));
    EXPECT_THAT(all, HasSubstr("listening on 127.0.0.1:"));
    EXPECT_THAT(all, HasSubstr(full.string()));
    EXPECT_EQ(levels["error"], 1) << run.err;
    EXPECT_GT(levels["info"], 1);
}

}  // namespace
}  // namespace osteomill::testing
