// The link against a server that is scripted to misbehave.
#include <gmock/gmock.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "common/wire/frame.h"
#include "common/wire/scene_messages.h"
#include "common/wire/sealed_frame.h"
#include "common/wire/session_info.h"
#include "common/wire/snapshot.h"
#include "render_client/link/bone_link.h"
#include "tests/support/block.h"
#include "tests/support/eventually.h"
#include "tests/support/packed.h"

namespace osteomill {
namespace {

using boost::asio::ip::tcp;
using testing::eventually;
using ::testing::HasSubstr;

/// A server that sends each connection the test's bytes.
class HostileServer : public ::testing::Test {
  protected:
    HostileServer() { acceptor_.non_blocking(true); }

    /// Waits for the link to connect, polling it meanwhile. Hangs up on the connection before.
    void accept() {
        socket_ = tcp::socket(io_);
        sequence_ = 0;
        ASSERT_TRUE(eventually([this] {
            poll();
            boost::system::error_code error;
            acceptor_.accept(socket_, error);
            return !error;
        }));
    }
    void send(const std::string& bytes) {
        boost::system::error_code ignored;
        boost::asio::write(socket_, boost::asio::buffer(bytes), ignored);
    }
    std::string bytes_of(v2::ServerFrame frame) {
        frame.set_sequence(++sequence_);
        std::string bytes;
        append_sealed_frame(frame, bytes);
        return bytes;
    }
    void send(const v2::ServerFrame& frame) { send(bytes_of(frame)); }

    v2::ServerFrame hello() const {
        v2::ServerFrame frame;
        frame.mutable_hello()->set_protocol_major(protocol_major);
        frame.mutable_hello()->set_protocol_minor(protocol_minor);
        *frame.mutable_hello()->add_burrs() = to_message(Burr{});
        return frame;
    }
    v2::ServerFrame answer(std::uint64_t bone_checksum, std::vector<std::uint32_t> differing) {
        v2::ServerFrame frame = state(bone_checksum);
        frame.mutable_state()->mutable_comparison()->mutable_differing_part()->Assign(differing.begin(),
                                                                                      differing.end());
        return frame;
    }
    v2::ServerFrame state(std::uint64_t bone_checksum) {
        v2::ServerFrame frame;
        *frame.mutable_state()->mutable_tool() = to_message(ToolState{});
        frame.mutable_state()->set_bone_checksum(bone_checksum);
        return frame;
    }
    /// Hello and a whole snapshot.
    void greet() {
        send(hello());
        v2::ServerFrame frame;
        *frame.mutable_snapshot_begin() = snapshot_begin(bone_);
        send(frame);
        *frame.mutable_snapshot_bricks() = SnapshotPacker().pack(bone_, 0);
        send(frame);
        frame.mutable_snapshot_end()->set_checksum(checksum(bone_));
        send(frame);
    }
    void greet_until_live() {
        accept();
        greet();
        ASSERT_TRUE(eventually([this] { return poll().status == LinkStatus::live; }));
    }
    const LinkUpdate& poll() { return last_ = link_.poll(); }
    /// Waits for a loss that says this, then expects the link to return for a fresh snapshot.
    void expect_loss(const std::string& why) {
        EXPECT_TRUE(eventually([this] { return poll().status == LinkStatus::lost; }));
        EXPECT_THAT(last_.status_line, HasSubstr(why));
        EXPECT_NE(link_.bone(), nullptr);
        greet_until_live();
        send(state(checksum(bone_)));
        const std::uint64_t verified = last_.checksums_verified;
        EXPECT_TRUE(eventually([&] { return poll().checksums_verified > verified; }));
    }

    boost::asio::io_context io_;
    tcp::acceptor acceptor_{io_, {boost::asio::ip::address_v4::loopback(), 0}};
    tcp::socket socket_{io_};
    std::uint64_t sequence_ = 0;
    Bone bone_ = testing::make_block({0, 0, 0}, {3.2, 1.6, 1.6}, 0.1);
    BoneLink link_{"127.0.0.1", acceptor_.local_endpoint().port()};
    LinkUpdate last_;
};

TEST_F(HostileServer, IsRefusedIfItSpeaksAnotherMajorVersion) {
    accept();
    v2::ServerFrame frame = hello();
    frame.mutable_hello()->set_protocol_major(protocol_major + 1);
    frame.mutable_hello()->set_program_version("9.1");
    send(frame);
    EXPECT_TRUE(eventually([this] { return poll().status == LinkStatus::refused; }));
    EXPECT_THAT(last_.status_line, HasSubstr("speaks protocol 3 (Osteomill 9.1), this program 2"));
    greet_until_live();  // it has been replaced meanwhile
}

TEST_F(HostileServer, IsAskedAfreshIfARepairHelpsNothing) {
    greet_until_live();
    send(state(checksum(bone_) + 1));       // the client asks
    send(answer(checksum(bone_) + 1, {}));  // and asks once more
    send(answer(checksum(bone_) + 1, {}));
    expect_loss("cannot be repaired");
    EXPECT_EQ(last_.repairs, 0U);
}

TEST_F(HostileServer, IsAskedAfreshIfItNeverAnswersAComparison) {
    greet_until_live();
    for (int i = 0; i < 30; ++i) send(state(checksum(bone_) + 1));
    expect_loss("cannot be repaired");
}

TEST_F(HostileServer, IsAskedAfreshIfItsAnswerMakesNoSense) {
    greet_until_live();
    send(state(checksum(bone_) + 1));
    send(answer(0, {2}));
    expect_loss("names part 2 of 2");
}

TEST_F(HostileServer, IsAskedAfreshIfFramesAreMissingFromARepair) {
    greet_until_live();
    send(state(checksum(bone_) + 1));
    ++sequence_;
    send(state(0));
    expect_loss("frames were lost while the bone was being repaired");
}

TEST_F(HostileServer, MayNotGoBackInItsSequence) {
    greet_until_live();
    sequence_ -= 2;
    send(state(0));
    expect_loss("frame 3 came after 4");
}

TEST_F(HostileServer, IsAskedAfreshAfterAChangeThatDoesNotFit) {
    greet_until_live();
    v2::ServerFrame frame = state(0);
    *frame.mutable_state()->mutable_changes() = testing::packed({{.change = {.brick = 12345}}});
    send(frame);
    expect_loss("brick 12345 lies outside the grid");
    EXPECT_EQ(last_.rejected_frames, 1U);
}

TEST_F(HostileServer, IsAskedAfreshAfterNonsense) {
    greet_until_live();
    send("\xff\xff\xff\xff\xff\xff");
    expect_loss("makes no sense");
    send(bytes_of(hello()));  // a second hello
    expect_loss("is not what should come there");
    send(std::string("\x03\xff\xff\xff", 4));
    expect_loss("no message");
}

TEST_F(HostileServer, IsAskedAfreshAndSaysSoAfterAFrameWhoseSealDoesNotHold) {
    greet_until_live();
    std::string sealed = bytes_of(state(0));
    sealed.back() ^= 1;
    send(sealed);
    expect_loss("makes no sense: a frame's checksum does not hold; trying again");
    EXPECT_EQ(last_.rejected_frames, 1U);
}

TEST_F(HostileServer, IsAskedAfreshIfItVanishesInTheMiddleOfAFrame) {
    greet_until_live();
    const std::string bytes = bytes_of(state(0));
    send(bytes.substr(0, bytes.size() / 2));
    socket_.close();
    expect_loss("trying again");
}

TEST_F(HostileServer, IsRejectedIfItsForceLimitIsNoNumber) {
    accept();
    v2::ServerFrame frame = hello();
    frame.mutable_hello()->set_force_limit_n(std::numeric_limits<double>::quiet_NaN());
    send(frame);
    EXPECT_TRUE(eventually([this] { return poll().status_line.find("force limit") != std::string::npos; }));
    EXPECT_EQ(last_.rejected_frames, 1U);
    EXPECT_EQ(link_.session(), nullptr);
}

TEST_F(HostileServer, CannotBreakTheStatusLine) {
    greet_until_live();
    v2::ServerFrame frame;
    frame.mutable_goodbye()->set_reason("over\n\x1b[2Jand out" + std::string(5000, '!'));
    send(frame);
    EXPECT_TRUE(eventually([this] { return poll().status == LinkStatus::finished; }));
    EXPECT_THAT(last_.status_line, HasSubstr("over\\x0a\\x1b[2Jand out!"));
    EXPECT_LT(last_.status_line.size(), 300U);
}

TEST_F(HostileServer, NeverGivesABoneThatIsNotWhole) {
    accept();
    send(hello());
    v2::ServerFrame frame;
    *frame.mutable_snapshot_begin() = snapshot_begin(bone_);
    send(frame);
    frame.mutable_snapshot_end()->set_checksum(checksum(bone_));
    send(frame);
    EXPECT_TRUE(eventually([this] { return poll().status == LinkStatus::lost; }));
    EXPECT_THAT(last_.status_line, HasSubstr("0 bricks came of the 2"));
    EXPECT_EQ(link_.bone(), nullptr);
    greet_until_live();
}

}  // namespace
}  // namespace osteomill
