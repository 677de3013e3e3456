// haptic_server, packet_replay and render_client as they run on two machines: TLS, on all addresses.
#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "tests/support/folder_test.h"
#include "tests/support/lab_certificates.h"
#include "tests/support/logged_removal.h"

namespace osteomill::testing {
namespace {

using ::testing::HasSubstr;

using Command = std::vector<std::string>;

class TlsPrograms : public FolderTest {
  protected:
    void SetUp() override {
        if (!has_openssl()) GTEST_SKIP() << "there is no openssl to make certificates with";
    }
    /// Draws until the session at `address` (0.0.0.0:PORT, as the server says it) is over.
    Command client(const std::string& address, const std::string& json) const {
        // OpenGL drivers leak and are unloaded before the leak checker of an instrumented client looks.
        return {"/usr/bin/env",
                "ASAN_OPTIONS=detect_leaks=0",
                RENDER_CLIENT,
                "--connect",
                "127.0.0.1" + address.substr(address.rfind(':')),
                "--offscreen",
                "--window-size",
                "160x120",
                "--frames",
                "100000",
                "--json",
                file(json)};
    }
};

TEST_F(TlsPrograms, ServeTheLabOnAllAddressesAndTheBonesAreEqual) {
    const LabCertificates lab;
    const TlsFiles bench = lab.server("bench");
    const TlsFiles viewer = lab.client("viewer");
    ChildProcess server(with({HAPTIC_SERVER, "--listen", "0.0.0.0:0", "--json", file("server.json"),
                              "--record", file("a.pcap"), "--log-csv", file("force.csv")},
                             bench));
    const auto address = server.line_after("listening on ");
    ASSERT_TRUE(address) << server.err();
    ChildProcess member(with(client(*address, "member.json"), viewer));
    EXPECT_TRUE(has_logged(server, "(viewer) joined")) << server.err();
    EXPECT_TRUE(has_removed(folder_ / "force.part.csv", 0.1)) << server.err();
    server.send_signal(SIGINT);
    ASSERT_EQ(server.wait(), 0) << server.err();
    ASSERT_EQ(member.wait(), 0) << member.err();
    EXPECT_EQ(json("member.json").at("bone_checksum"), json("server.json").at("bone_checksum"));
    EXPECT_EQ(json("member.json").at("checksum_mismatches"), 0);

    ChildProcess replay(
        with({PACKET_REPLAY, file("a.pcap"), "--listen", "0.0.0.0:0", "--speed", "4"}, bench));
    const auto replayed = replay.line_after("listening on ");
    ASSERT_TRUE(replayed) << replay.err();
    ChildProcess again(with(client(*replayed, "again.json"), viewer));
    ASSERT_EQ(replay.wait(), 0) << replay.err();
    ASSERT_EQ(again.wait(), 0) << again.err();
    EXPECT_EQ(json("again.json").at("bone_checksum"), json("server.json").at("bone_checksum"));
}

TEST_F(TlsPrograms, SayInOneLineWhatIsMissing) {
    const TlsFiles nowhere{"/nowhere/a.pem", "/nowhere/a.key", "/nowhere/ca.pem"};
    for (const auto& [command, status, words] :
         {std::tuple(Command{HAPTIC_SERVER, "--tls-cert", "a.pem"}, 2, "--tls-key: is missing"),
          std::tuple(Command{PACKET_REPLAY, "a.pcap", "--tls-key", "a.key"}, 2, "--tls-cert: is missing"),
          std::tuple(Command{RENDER_CLIENT, "--tls-ca", "ca.pem"}, 2, "--tls-cert: is missing"),
          std::tuple(Command{HAPTIC_SERVER, "--listen", "0.0.0.0:0"}, 2, "--insecure-network"),
          std::tuple(Command{PACKET_REPLAY, "a.pcap", "--listen", "0.0.0.0:0"}, 2, "--insecure-network"),
          std::tuple(with({HAPTIC_SERVER}, nowhere), 1, "/nowhere/a.pem: cannot be read"),
          std::tuple(with({PACKET_REPLAY, "a.pcap"}, nowhere), 1, "/nowhere/a.pem: cannot be read"),
          std::tuple(with({RENDER_CLIENT, "--offscreen"}, nowhere), 1, "/nowhere/a.pem: cannot be read")}) {
        const Finished run = run_program(command);
        EXPECT_EQ(run.status, status) << run.err;
        EXPECT_THAT(run.err, HasSubstr(words));
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
}

}  // namespace
}  // namespace osteomill::testing
