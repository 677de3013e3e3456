// Access to a server, the right to move the tool, and their loss: haptic_server, packet_replay and
// render_client with the certificates of a lab, lists of operators and of revoked certificates, and strangers
// who take up places.
#include <gmock/gmock.h>

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "common/net/tls_context.h"
#include "common/wire/frame.h"
#include "common/wire/session_info.h"
#include "osteomill/v2/session.pb.h"
#include "render_client/link/bone_link.h"
#include "tests/support/child_process.h"
#include "tests/support/eventually.h"
#include "tests/support/half_open_flood.h"
#include "tests/support/lab_certificates.h"
#include "tests/support/link_proxy.h"
#include "tests/support/messages.h"

namespace osteomill::testing {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

using Command = std::vector<std::string>;

/// OpenGL drivers leak and are unloaded before the leak checker of an instrumented client looks.
Command drawing_client(const std::string& where) {
    return {"/usr/bin/env",  "ASAN_OPTIONS=detect_leaks=0",
            RENDER_CLIENT,   "--connect",
            where,           "--offscreen",
            "--window-size", "160x120",
            "--frames",      "1"};
}

/// A client of the lab that ignores rules: it requests the tool whatever the server has answered.
class Insistent {
  public:
    Insistent(std::uint16_t port, const TlsFiles& files) : tls_(files, TlsContext::Role::client) {
        stream_.lowest_layer().connect({boost::asio::ip::address_v4::loopback(), port});
        stream_.handshake(boost::asio::ssl::stream_base::client);
        v2::ClientFrame hello;
        hello.mutable_hello()->set_protocol_major(protocol_major);
        say(hello);
    }
    void press_pedal() {
        v2::ClientFrame frame;
        auto& input = *frame.mutable_operator_input();
        input.mutable_hand_target_mm()->set_x(1.0);
        input.mutable_spindle_axis()->set_z(1.0);
        input.set_pedal(true);
        say(frame);
    }

  private:
    void say(v2::ClientFrame& frame) {
        frame.set_sequence(++sequence_);
        std::string bytes;
        append_frame(frame, bytes);
        boost::system::error_code ignored;  // one who is hung up on shows in the server's log
        boost::asio::write(stream_, boost::asio::buffer(bytes), ignored);
    }

    boost::asio::io_context io_;
    TlsContext tls_;
    boost::asio::ssl::stream<boost::asio::ip::tcp::socket> stream_{io_, tls_.context()};
    std::uint64_t sequence_ = 0;
};

class Doors : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!has_openssl()) GTEST_SKIP() << no_openssl;
        lab_.emplace();
    }
    std::string file(const std::string& name) const { return (folder_ / name).string(); }

    /// In the clear if there are no files. Without a hand of its own, whose session would end by itself.
    void start_server(const TlsFiles& files, const Command& more = {}) {
        Command command = with({HAPTIC_SERVER, "--listen", "127.0.0.1:0", "--device", "client"}, files);
        command.insert(command.end(), more.begin(), more.end());
        server_.emplace(command);
        const auto address = server_->address();
        ASSERT_TRUE(address) << server_->err();
        port_ = static_cast<std::uint16_t>(std::stoi(address->substr(address->rfind(':') + 1)));
    }
    std::string where() const { return "127.0.0.1:" + std::to_string(port_); }
    std::unique_ptr<BoneLink> link(const TlsFiles& files) const { return link(files, port_); }
    static std::unique_ptr<BoneLink> link(const TlsFiles& files, std::uint16_t port) {
        return std::make_unique<BoneLink>("127.0.0.1", port, std::nullopt, files);
    }
    static bool is_live(BoneLink& link) {
        return eventually([&] { return link.poll().status == LinkStatus::live; });
    }
    static bool is_told(BoneLink& link, ToolDriver driver) {
        return eventually([&] {
            const auto tool = link.poll().tool;
            return tool && tool->driver == driver;
        });
    }
    /// Waits until the server's log says so.
    bool is_logged(const std::string& words) {
        return eventually([&] {
            server_->wait(0s);
            return server_->err().find(words) != std::string::npos;
        });
    }
    void end_session() {
        server_->send_signal(SIGINT);
        EXPECT_EQ(server_->wait(), 0) << server_->err();
    }

    TemporaryFolder folder_;
    std::optional<LabCertificates> lab_;
    std::optional<ChildProcess> server_;
    std::uint16_t port_ = 0;
};

TEST_F(Doors, LetOperatorsAloneMoveTheToolAndTellTheOthersThatTheyWatch) {
    std::ofstream(file("operators")) << "# who may drill\nCN=surgeon\n";
    start_server(lab_->server("bench"), {"--operators", file("operators")});
    const auto watcher = link(lab_->client("student"));
    ASSERT_TRUE(is_live(*watcher));
    EXPECT_FALSE(watcher->session()->accepts_operator);
    EXPECT_TRUE(is_told(*watcher, ToolDriver::others_only));

    Insistent insistent(port_, lab_->client("rascal"));
    for (int i = 0; i < 20; ++i) insistent.press_pedal();
    EXPECT_TRUE(is_logged("(rascal) may only watch; what it asks of the tool is refused")) << server_->err();

    auto surgeon = link(lab_->client("surgeon"));
    ASSERT_TRUE(is_live(*surgeon));
    EXPECT_TRUE(surgeon->session()->accepts_operator);
    EXPECT_TRUE(is_told(*surgeon, ToolDriver::nobody)) << "rascal has not got it";
    EXPECT_TRUE(eventually([&] {
        surgeon->send_operator(
            {.hand_target_mm = watcher->poll().tool.value_or(ToolState{}).hand_position_mm});
        const auto tool = surgeon->poll().tool;
        return tool && tool->driver == ToolDriver::you;
    }));
    surgeon.reset();
    EXPECT_TRUE(is_logged("(surgeon) no longer moves the tool"));
    end_session();
    EXPECT_THAT(server_->err(), HasSubstr("(surgeon) moves the tool"));
    EXPECT_THAT(server_->err(), Not(HasSubstr("(rascal) moves the tool")));
    EXPECT_THAT(server_->err(), Not(HasSubstr("(student) may only watch; "))) << "it asked for nothing";
}

TEST_F(Doors, OpenForOperatorsOnlyWhereItIsKnownWhoTheyAre) {
    std::ofstream(file("operators")) << "surgeon\n";
    const TlsFiles bench = lab_->server("bench");
    for (const auto& [command, status, words] :
         {std::tuple(Command{HAPTIC_SERVER, "--device", "client", "--operators", file("operators")}, 2,
                     "--operators: needs TLS"),
          std::tuple(with({HAPTIC_SERVER, "--operators", file("operators")}, bench), 2,
                     "--operators: goes with --device client"),
          std::tuple(with({HAPTIC_SERVER, "--device", "client", "--operators", file("operators")}, bench), 1,
                     "operators:1: 'surgeon' is no subject"),
          std::tuple(with({HAPTIC_SERVER, "--device", "client", "--operators", "/nowhere/list"}, bench), 1,
                     "/nowhere/list: cannot be read")}) {
        const Finished run = run_program(command);
        EXPECT_EQ(run.status, status) << run.err;
        EXPECT_THAT(run.err, HasSubstr(words));
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
}

/// Strangers come 1000 times a second and stay; a client joins over a link with a round trip of 50 ms, as if
/// behind the same address, and one over a far slower link from another. If the machine was busy with other
/// work, one may be turned away once.
class DoorsInAFlood : public Doors, public ::testing::WithParamInterface<bool> {
  protected:
    std::optional<TlsFiles> files_of(const std::string& name) const {
        return GetParam() ? std::optional(lab_->client(name)) : std::nullopt;
    }
    void start() {
        if (GetParam()) return start_server(lab_->server("bench"));
        start_server({});
    }
    /// Number of `clients`, one after the other, that were turned away before they got in.
    int turned_away(int clients, std::uint16_t port) const {
        int away = 0;
        const auto files = files_of("viewer" + std::to_string(port));
        for (int i = 0; i < clients; ++i) {
            BoneLink client("127.0.0.1", port, std::nullopt, files);
            bool was_away = false;
            EXPECT_TRUE(eventually([&] {
                const LinkUpdate update = client.poll();
                was_away = was_away || update.status_line.find("trying again") != std::string::npos;
                return update.status == LinkStatus::live;
            })) << client.poll().status_line;
            away += was_away ? 1 : 0;
        }
        return away;
    }
};

TEST_P(DoorsInAFlood, StayOpenToClientsBehindTheSameAddress) {
    start();
    LinkProxy far(port_, {.delay = 25ms});
    const HalfOpenFlood flood(port_, 1000.0);
    std::this_thread::sleep_for(1s);  // until it has taken all there is to take
    EXPECT_LE(turned_away(8, far.port()), 1);
    if (GetParam()) {
        const Finished drawn = run_program(
            with(drawing_client("127.0.0.1:" + std::to_string(far.port())), *files_of("drawing")));
        EXPECT_EQ(drawn.status, 0) << drawn.err;
    }
    std::printf("%.0f half-open connections a second\n", flood.rate_per_s());
    end_session();
}

TEST_P(DoorsInAFlood, StayOpenToClientsFarAwayAtAnotherAddress) {
    start();
    LinkProxy very_far(port_, {.delay = 400ms});
    const HalfOpenFlood flood(port_, 1000.0, "127.0.0.2");
    std::this_thread::sleep_for(1s);
    EXPECT_LE(turned_away(2, very_far.port()), 1);
    std::printf("%.0f half-open connections a second\n", flood.rate_per_s());
    end_session();
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutTls, DoorsInAFlood, ::testing::Bool(),
                         [](const auto& tls) { return std::string(tls.param ? "Tls" : "Plain"); });

TEST_F(Doors, AreNotOpenedWithCertificatesAndKeysThatNobodyShouldTrust) {
    const TlsFiles bench = lab_->server("bench");
    const TlsFiles viewer = lab_->client("viewer");
    TlsFiles open_bench = lab_->server("open");
    std::filesystem::permissions(open_bench.key, std::filesystem::perms(0644));
    TlsFiles open_viewer = lab_->client("ajar");
    std::filesystem::permissions(open_viewer.key,
                                 std::filesystem::perms(0640) | std::filesystem::perms::others_read);
    const TlsFiles past_bench = lab_->expired_server();
    TlsFiles swapped = bench;
    swapped.key = viewer.key;
    TlsFiles other_list = bench;
    const LabCertificates other;
    other_list.crl = other.revoke();

    const LabCertificates past;
    const TlsFiles past_viewer = past.expired_client();
    const Command serve{HAPTIC_SERVER, "--listen", "127.0.0.1:0", "--duration-s", "0.1"};
    const Command replay{PACKET_REPLAY, "none.pcap", "--listen", "127.0.0.1:0"};
    const Command draw = drawing_client("127.0.0.1:9");
    for (const auto& [command, words] :
         {std::pair(with(serve, open_bench),
                    "open.key: is a private key that others may read (its mode is 644)"),
          std::pair(with(replay, open_bench), "open.key: is a private key that others may read"),
          std::pair(with(draw, open_viewer),
                    "ajar.key: is a private key that others may read (its mode is 644)"),
          std::pair(with(serve, past_bench), "past.pem: has expired, on 20"),
          std::pair(with(replay, past_bench), "past.pem: has expired, on 20"),
          std::pair(with(draw, past_viewer), "past.pem: has expired, on 20"),
          std::pair(with(serve, viewer), "viewer.pem: is no server's certificate"),
          std::pair(with(replay, viewer), "viewer.pem: is no server's certificate"),
          std::pair(with(draw, bench), "bench.pem: is no client's certificate"),
          std::pair(with(serve, swapped), "viewer.key: is not the key of"),
          std::pair(with(replay, other_list), "crl.pem: is not signed by the CA of"),
          std::pair(with(serve, other_list), "crl.pem: is not signed by the CA of")}) {
        const Finished run = run_program(command);
        EXPECT_EQ(run.status, 1) << run.err;
        EXPECT_THAT(run.err, HasSubstr(words));
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
}

TEST_F(Doors, CloseOnOneWhoseCertificateIsRevokedWhileTheServerRuns) {
    TlsFiles bench = lab_->server("bench");
    bench.crl = lab_->revoke();
    start_server(bench);
    const auto lost = link(lab_->client("lost"));
    const auto other = link(lab_->client("other"));
    ASSERT_TRUE(is_live(*lost));
    ASSERT_TRUE(is_live(*other));

    lab_->revoke("lost");
    EXPECT_TRUE(eventually([&] { return lost->poll().status == LinkStatus::refused; }));
    EXPECT_THAT(lost->poll().status_line, HasSubstr("certificate revoked"));
    EXPECT_TRUE(is_logged("(lost) was dropped: its certificate is revoked"));

    // A list that was torn while it was written changes nothing.
    std::ifstream whole(bench.crl);
    const std::string list(std::istreambuf_iterator<char>(whole), {});
    std::ofstream(bench.crl) << list.substr(0, list.size() / 2);
    EXPECT_TRUE(is_logged(
        "crl.pem: holds no whole list of revoked certificates in PEM form; the list before it holds on"));
    const auto late = link(lab_->client("late"));
    EXPECT_TRUE(is_live(*late));
    const Finished again = run_program(with(
        drawing_client(where()),
        {.certificate = lab_->folder() / "lost.pem", .key = lab_->folder() / "lost.key", .ca = bench.ca}));
    EXPECT_EQ(again.status, 1);
    EXPECT_THAT(again.err, AllOf(HasSubstr("turned this client away"), HasSubstr("certificate revoked")));
    EXPECT_EQ(other->poll().connections, 1U);
    end_session();
}

TEST_F(Doors, SayAtOnceInOneLineThatACertificateIsRefused) {
    start_server(lab_->server("bench"));
    const LabCertificates elsewhere;
    const TlsFiles stranger = elsewhere.client("stranger");
    TlsFiles wary = lab_->client("wary");
    wary.crl = lab_->revoke("bench");
    for (const auto& [files, words] :
         {std::pair(stranger, certificate_refused),
          std::pair(lab_->impostor(stranger), std::string("turned this client away")),
          std::pair(wary, certificate_refused + ": certificate revoked")}) {
        const Finished run = run_program(with(drawing_client(where()), files));
        EXPECT_EQ(run.status, 1);
        EXPECT_THAT(run.err, AllOf(HasSubstr(words), HasSubstr("no bone to draw")))
            << "and not that there was none after so many seconds";
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
    end_session();
}

}  // namespace
}  // namespace osteomill::testing
