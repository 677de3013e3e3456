// Faults of a network and its people in a session with the real server: afterwards every client that still
// lives has the server's bone bit for bit, and the server has kept within its memory.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "common/wire/frame.h"
#include "common/wire/session_info.h"
#include "haptic_server/program/session_json.h"
#include "osteomill/v2/session.pb.h"
#include "render_client/link/bone_link.h"
#include "studies/bridge/private_network.h"
#include "tests/support/block_file.h"
#include "tests/support/child_process.h"
#include "tests/support/eventually.h"
#include "tests/support/folder_test.h"
#include "tests/support/link_proxy.h"
#include "tests/support/milling_motion.h"

namespace osteomill::testing {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

using Command = std::vector<std::string>;
using Links = std::vector<std::unique_ptr<BoneLink>>;

/// A stranger that connects to a server's port: a scan, or a program that stands still.
class Stranger {
  public:
    explicit Stranger(std::uint16_t port) : Stranger("127.0.0.1", port) {}
    Stranger(const std::string& address, std::uint16_t port) {
        boost::system::error_code ignored;  // who is turned away has been there all the same
        socket_.connect({boost::asio::ip::make_address(address), port}, ignored);
    }
    void say(const std::string& bytes) {
        boost::system::error_code ignored;
        boost::asio::write(socket_, boost::asio::buffer(bytes), ignored);
    }
    /// Sends a client's greeting; never reads the answer.
    void greet() {
        v2::ClientFrame frame;
        frame.set_sequence(1);
        frame.mutable_hello()->set_protocol_major(protocol_major);
        std::string bytes;
        append_frame(frame, bytes);
        say(bytes);
    }

  private:
    boost::asio::io_context io_;
    boost::asio::ip::tcp::socket socket_{io_};
};

class LinkFaults : public FolderTest {
  protected:
    LinkFaults() { write_block(file("block.nrrd"), 300); }

    /// Mills slowly for minutes, until a signal ends it; leaves server.json.
    void start_server(const Command& options = {"--listen", "127.0.0.1:0"}) {
        write_milling_motion(file("motion.csv"));
        Command command{HAPTIC_SERVER,      "--bone", file("block.nrrd"), "--trajectory",
                        file("motion.csv"), "--json", file("server.json")};
        command.insert(command.end(), options.begin(), options.end());
        server_ = std::make_unique<ChildProcess>(command);
        const auto address = server_->address();
        ASSERT_TRUE(address) << server_->err();
        port_ = static_cast<std::uint16_t>(std::stoi(address->substr(address->rfind(':') + 1)));
    }
    std::uint64_t server_memory_bytes() const {
        std::ifstream status("/proc/" + std::to_string(server_->pid()) + "/status");
        return peak_resident_bytes(status).value_or(0);
    }

    /// Polls all links, as their windows would, until each of them has been so.
    template <typename Condition>
    static bool poll_until(const Links& links, Condition&& condition) {
        std::vector<bool> has_been(links.size(), false);
        return eventually([&] {
            for (std::size_t i = 0; i < links.size(); ++i)
                has_been[i] = condition(links[i]->poll()) || has_been[i];
            return std::ranges::find(has_been, false) == has_been.end();
        });
    }
    static bool is_live(const LinkUpdate& update) { return update.status == LinkStatus::live; }

    /// Ends the session once bone has been cut, and all of them with it.
    void expect_equal_bones_at_the_end(const Links& links) {
        const bool has_cut = poll_until(
            links, [](const LinkUpdate& update) { return update.tool && update.tool->removed_mm3 > 0.1; });
        server_->send_signal(SIGINT);
        EXPECT_TRUE(poll_until(
            links, [](const LinkUpdate& update) { return update.status == LinkStatus::finished; }));
        ASSERT_EQ(server_->wait(), 0) << server_->err();
        EXPECT_TRUE(has_cut) << server_->err();
        const std::string served = json("server.json").at("bone_checksum");
        for (const auto& link : links) {
            EXPECT_EQ(fmt::format("{:016x}", checksum(*link->bone())), served);
            EXPECT_EQ(link->poll().checksum_mismatches, 0U);
            EXPECT_EQ(link->poll().rejected_frames, 0U);
        }
    }
    std::unique_ptr<ChildProcess> server_;
    std::uint16_t port_ = 0;
};

TEST_F(LinkFaults, OfLinksThatAreCutLateDroppedOrKilledLeaveEveryBoneEqual) {
    start_server();
    LinkProxy good(port_), cut(port_), late(port_, {.delay = 100ms, .jitter = 50ms});
    LinkProxy slow(port_, {.bytes_per_s = 20'000});
    Links links;
    for (const LinkProxy* proxy : {&good, &cut, &late})
        links.push_back(std::make_unique<BoneLink>("127.0.0.1", proxy->port()));
    ASSERT_TRUE(poll_until(links, is_live));

    // The same snapshot takes another client so long that it can be killed in the middle.
    const std::uint64_t snapshot_bytes = good.bytes_to_clients();
    {
        ChildProcess killed({"/usr/bin/env", "ASAN_OPTIONS=detect_leaks=0", RENDER_CLIENT, "--connect",
                             "127.0.0.1:" + std::to_string(slow.port()), "--offscreen", "--window-size",
                             "64x48", "--frames", "100000"});
        ASSERT_TRUE(eventually([&] { return slow.bytes_to_clients() > snapshot_bytes / 8; }));
        killed.send_signal(SIGKILL);
        EXPECT_LT(slow.bytes_to_clients(), snapshot_bytes / 2);
    }

    cut.cut();
    late.drop();
    // Longer than a client waits for a server that says nothing.
    EXPECT_TRUE(eventually([&] {
        const std::string line = links[1]->poll().status_line;
        links[0]->poll();
        links[2]->poll();
        return line.find("is silent") != std::string::npos;
    }));
    EXPECT_EQ(links[0]->poll().connections, 1U) << "others notice nothing";
    cut.heal();
    ASSERT_TRUE(poll_until(links, is_live));
    EXPECT_EQ(links[1]->poll().connections, 2U);
    EXPECT_EQ(links[2]->poll().connections, 2U);
    expect_equal_bones_at_the_end(links);
}

TEST_F(LinkFaults, OfStrangersNeitherKeepClientsOutNorFillTheMemory) {
    start_server();
    Links links;
    for (int i = 0; i < 30; ++i) links.push_back(std::make_unique<BoneLink>("127.0.0.1", port_));
    ASSERT_TRUE(poll_until(links, is_live));
    const std::uint64_t before_bytes = server_memory_bytes();

    Stranger deaf(port_);  // and the 31st client
    deaf.greet();
    std::vector<std::unique_ptr<Stranger>> hanging_on;
    const auto began = std::chrono::steady_clock::now();
    for (int i = 0; i < 50; ++i) {  // 1000 a minute
        auto stranger = std::make_unique<Stranger>(port_);
        if (i % 3 == 0) stranger->say("GET / HTTP/1.0\r\n\r\n");
        if (i % 3 == 1) hanging_on.push_back(std::move(stranger));
        if (i == 25) links.push_back(std::make_unique<BoneLink>("127.0.0.1", port_));
        const auto next = began + (i + 1) * 60ms;
        do {
            for (const auto& link : links) link->poll();
        } while (std::chrono::steady_clock::now() < next);
    }
    EXPECT_TRUE(poll_until(links, is_live)) << "the 32nd client came in the middle of it";
    for (const auto& link : links) EXPECT_EQ(link->poll().connections, 1U);
    // For each of 32 clients and 48 strangers, the pending changes (see PendingChanges) of the block's 120
    // bricks, and two frames of 128 KiB.
    EXPECT_LT(server_memory_bytes() - before_bytes, 80U * (120U * 600U + 2U * 131'072U));
    expect_equal_bones_at_the_end(links);
}

TEST_F(LinkFaults, OfAServerKilledWhileItRecordsLeaveAFileAndClientsForTheNext) {
    start_server({"--listen", "127.0.0.1:0", "--record", file("a.pcap")});
    Links links;
    links.push_back(std::make_unique<BoneLink>("127.0.0.1", port_));
    ASSERT_TRUE(poll_until(
        links, [](const LinkUpdate& update) { return update.tool && update.tool->removed_mm3 > 0.1; }));
    // Two seconds later, the file has it as well as the client.
    const auto seen = links[0]->poll().checksums_verified;
    ASSERT_TRUE(
        poll_until(links, [&](const LinkUpdate& update) { return update.checksums_verified >= seen + 2; }));
    const auto recorded = [&] { return std::filesystem::file_size(file("a.part.pcap")); };
    const auto by_then = recorded();
    ASSERT_TRUE(eventually([&] { return recorded() > by_then; }));
    server_->send_signal(SIGKILL);
    ASSERT_EQ(server_->wait(), 128 + SIGKILL);
    ASSERT_TRUE(
        poll_until(links, [](const LinkUpdate& update) { return update.status == LinkStatus::lost; }));

    const Finished read =
        run_program({PACKET_REPLAY, file("a.part.pcap"), "--info", "--json", file("info.json")});
    EXPECT_EQ(read.status, 0) << read.err;
    EXPECT_FALSE(json("info.json").at("ends_with_goodbye"));
    EXPECT_GT(json("info.json").at("removed_mm3").at("total"), 0.0);

    start_server({"--listen", "127.0.0.1:" + std::to_string(port_)});
    ASSERT_TRUE(poll_until(links, [](const LinkUpdate& update) { return update.connections == 2; }));
    expect_equal_bones_at_the_end(links);
}

TEST_F(LinkFaults, OfANarrowCableAndOneThatIsPulledLeaveTheBoneEqual) {
    if (const std::string why = study::PrivateNetwork::why_not(); !why.empty()) GTEST_SKIP() << why;
    study::PrivateNetwork cable;
    cable.limit_rate("64kbit");
    {
        const study::PrivateNetwork::Stay there(cable.server());
        start_server({"--listen", "0.0.0.0:0", "--insecure-network"});
    }
    Links links;
    {
        const study::PrivateNetwork::Stay there(cable.client());
        links.push_back(std::make_unique<BoneLink>(study::PrivateNetwork::server_address, port_));
    }
    ASSERT_TRUE(poll_until(links, is_live));
    EXPECT_TRUE(poll_until(links, [](const LinkUpdate& update) { return update.frames >= 20; }));
    cable.pull_cable();
    EXPECT_TRUE(
        poll_until(links, [](const LinkUpdate& update) { return update.status == LinkStatus::lost; }));
    cable.limit_rate("1mbit");
    cable.plug_cable();
    EXPECT_TRUE(poll_until(links, [](const LinkUpdate& update) { return update.connections == 2; }));
    expect_equal_bones_at_the_end(links);
}

}  // namespace
}  // namespace osteomill::testing
