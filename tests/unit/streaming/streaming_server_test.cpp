#include "haptic_server/streaming/streaming_server.h"

#include <gmock/gmock.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <limits>
#include <utility>

#include "common/recording/playhead.h"
#include "common/recording/recording_reader.h"
#include "common/wire/frame.h"
#include "common/wire/scene_messages.h"
#include "haptic_server/streaming/client_message.h"
#include "render_client/link/bone_link.h"
#include "tests/support/message_of.h"
#include "tests/support/replica.h"
#include "tests/support/served_bone.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using boost::asio::ip::tcp;
using testing::eventually;
using testing::ServedBone;

v2::ClientFrame greeting(std::uint32_t major = protocol_major) {
    v2::ClientFrame frame;
    frame.set_sequence(1);
    frame.mutable_hello()->set_protocol_major(major);
    return frame;
}

enum class Says { hello, nothing };

/// A client that sends at most a hello, and then only what the test sends: its next frame is number 2.
class RawClient {
  public:
    explicit RawClient(std::uint16_t port, Says first = Says::hello) {
        socket_.connect({boost::asio::ip::address_v4::loopback(), port});
        socket_.non_blocking(true);
        if (first == Says::hello) send(greeting());
    }
    void send(const std::string& bytes) {
        boost::system::error_code ignored;  // the server may have hung up already
        boost::asio::write(socket_, boost::asio::buffer(bytes), ignored);
    }
    void send(const v2::ClientFrame& frame) {
        std::string bytes;
        append_frame(frame, bytes);
        send(bytes);
    }
    /// Passes received frames to the replica, one by one.
    void read_into(testing::Replica& replica) {
        std::array<std::uint8_t, 65536> bytes;
        boost::system::error_code error;
        while (const std::size_t count = socket_.read_some(boost::asio::buffer(bytes), error)) {
            decoder_.append(std::span(bytes).first(count));
            while (const auto message = decoder_.next()) {
                v2::ServerFrame frame;
                ASSERT_TRUE(frame.ParseFromArray(message->data(), static_cast<int>(message->size())));
                std::string one_frame;
                append_frame(frame, one_frame);
                replica.take(one_frame);
            }
        }
    }
    /// Reads until the server hangs up.
    bool is_dropped() {
        return eventually([this] {
            std::array<char, 65536> bytes;
            boost::system::error_code error;
            while (socket_.read_some(boost::asio::buffer(bytes), error) > 0) {
            }
            return error && error != boost::asio::error::would_block;
        });
    }

  private:
    boost::asio::io_context io_;
    tcp::socket socket_{io_};
    FrameDecoder decoder_;
};

v2::ClientFrame input_frame(std::uint64_t sequence, const OperatorCommand& command,
                            std::uint64_t answers_state = 0) {
    v2::ClientFrame frame;
    frame.set_sequence(sequence);
    *frame.mutable_operator_input() = to_message(command);
    frame.mutable_operator_input()->set_number(sequence);
    frame.mutable_operator_input()->set_answers_state(answers_state);
    return frame;
}

/// Polls until the link has this status.
bool reaches(BoneLink& link, LinkStatus status) {
    return eventually([&] { return link.poll().status == status; });
}

std::string failure_of(const StreamingOptions& options, const std::string& burr_name = "round") {
    const Bone bone = BoneBuilder::homogeneous({.size_voxels = {16, 16, 16}}, 1.0, false).build();
    ChangeQueue changes(16, bone.shared_content());
    TripleBuffer<ToolState> tool;
    Scene scene;
    scene.burrs = {Burr{.name = burr_name}};
    return testing::message_of<std::exception>([&] {
        LiveSession shown(tool, changes);
        StreamingServer server(options, session_info(scene, false, 3.3, "0.0.test"), bone, shown);
        server.start();
    });
}

TEST(StreamingServer, SaysInOneLineWhyItCannotListen) {
    EXPECT_THAT(failure_of({.address = "pluto", .port = 0}),
                ::testing::HasSubstr("\"pluto\" is no IP address"));
    EXPECT_THAT(failure_of({.address = "0.0.0.0", .port = 0}), ::testing::HasSubstr("without TLS"));
    EXPECT_EQ(failure_of({.address = "0.0.0.0", .port = 0, .insecure_network = true}), "");
    ServedBone other;
    EXPECT_THAT(failure_of({.port = other.port()}), ::testing::HasSubstr("in use"));
    EXPECT_THAT(failure_of({.frame_rate_hz = 0.0}), ::testing::HasSubstr("frame rate"));
    EXPECT_THAT(failure_of({.port = 0}, std::string(200'000, 'x')),
                ::testing::HasSubstr("the scene's names take"));
    EXPECT_EQ(failure_of({.port = 0}), "");
}

TEST(StreamingServer, StopsAtOnceWithoutClientsAndMayBeStoppedTwice) {
    ServedBone served;
    served.start_carving();
    served.stop_carving();
    served.stop();
    served.stop();
    EXPECT_EQ(served.mirror_checksum(), checksum(served.bone()));
}

TEST(StreamingServer, DropsClientsThatTalkNonsenseWhileOthersNoticeNothing) {
    ServedBone served(0, true);
    served.start_carving();
    BoneLink link("127.0.0.1", served.port());
    ASSERT_TRUE(reaches(link, LinkStatus::live));

    v2::ClientFrame no_body;
    no_body.set_sequence(2);
    const double not_a_number = std::numeric_limits<double>::quiet_NaN();
    {
        RawClient http(served.port()), oversize(served.port()), bodiless(served.port()), late(served.port()),
            nowhere(served.port()), burr(served.port()), doubter(served.port()), blind(served.port());
        http.send("GET / HTTP/1.1\r\nHost: osteomill.example\r\nAccept: text/html, any/any\r\n\r\n" +
                  std::string(200, 'x'));
        oversize.send("\xff\xff\xff\xff\xff\xff");
        bodiless.send(no_body);
        late.send(input_frame(7, {}));
        nowhere.send(input_frame(2, {.hand_target_mm = {0, not_a_number, 0}}));
        burr.send(input_frame(2, {.burr = 2}));
        v2::ClientFrame doubt;
        doubt.set_sequence(2);
        doubt.mutable_compare_bone();
        doubter.send(doubt);
        v2::ClientFrame view;
        view.set_sequence(2);
        view.mutable_viewpoint()->set_field_of_view_deg(30.0f);  // its axes are no rotation
        blind.send(view);
        RawClient rude(served.port(), Says::nothing), old(served.port(), Says::nothing);
        rude.send(input_frame(1, {}));
        old.send(greeting(protocol_major - 1));
        for (RawClient* client :
             {&http, &oversize, &bodiless, &late, &nowhere, &burr, &doubter, &blind, &rude, &old})
            EXPECT_TRUE(client->is_dropped());
    }
    EXPECT_FALSE(served.operator_command().has_value());

    const std::uint64_t verified = link.poll().checksums_verified;
    EXPECT_TRUE(eventually([&] { return link.poll().checksums_verified > verified; }));
    const LinkUpdate update = link.poll();
    EXPECT_EQ(update.status, LinkStatus::live);
    EXPECT_EQ(update.connections, 1U);
    EXPECT_EQ(update.checksum_mismatches, 0U);
}

TEST(StreamingServer, DropsAClientThatSaysMoreThanAnyoneHasToSay) {
    ServedBone served(0, true);
    std::string flood;
    for (std::uint64_t i = 2; i <= 5000; ++i) append_frame(input_frame(i, {.pedal = true}), flood);
    RawClient steady(served.port()), loud(served.port()), long_winded(served.port());
    std::string wordy;
    for (std::uint64_t i = 2; i <= 1000; ++i) append_frame(input_frame(i, {.pedal = true}), wordy);
    steady.send(wordy);
    testing::Replica seen;
    EXPECT_TRUE(eventually([&] {
        steady.read_into(seen);
        return seen.states() > 0;
    }));
    steady.send(input_frame(1001, {.pedal = true}, seen.sequence()));
    EXPECT_TRUE(eventually([&] { return served.operator_command() && served.operator_command()->pedal; }));
    loud.send(flood);
    EXPECT_TRUE(loud.is_dropped());
    std::string frame;
    append_frame(std::string(largest_client_frame_bytes + 1, 'x'), frame);
    long_winded.send(frame.substr(0, 3));  // its length is enough
    EXPECT_TRUE(long_winded.is_dropped());
    BoneLink link("127.0.0.1", served.port());
    EXPECT_TRUE(reaches(link, LinkStatus::live));
}

TEST(StreamingServer, MovesTheToolOnlyForWhoAnswersWhatIsNow) {
    ServedBone served(0, true);
    RawClient client(served.port());
    client.send(input_frame(2, {.pedal = true}));
    testing::Replica seen;
    ASSERT_TRUE(eventually([&] {
        client.read_into(seen);
        return seen.states() > 0;
    }));
    EXPECT_FALSE(served.operator_command().has_value()) << "it named no state";
    const std::uint64_t first_state = seen.sequence();
    client.send(input_frame(3, {.pedal = true, .burr = 1}, first_state));
    EXPECT_TRUE(
        eventually([&] { return served.operator_command() && served.operator_command()->burr == 1; }));

    served.start_carving();  // so that there is something newer to tell
    ASSERT_TRUE(eventually([&] {
        client.read_into(seen);
        return seen.states() > 20;
    }));
    const std::uint64_t old_state = seen.sequence();
    ASSERT_TRUE(eventually([&] {
        client.read_into(seen);
        return seen.sequence() > old_state;
    }));
    std::this_thread::sleep_for(2 * AnsweredStates::longest_age);
    client.read_into(seen);
    client.send(input_frame(4, {.burr = 0}, first_state));  // old news
    client.send(input_frame(5, {.burr = 0}, old_state));
    v2::ClientFrame again = input_frame(6, {.burr = 0}, seen.sequence());
    again.mutable_operator_input()->set_number(3);
    client.send(again);
    const std::size_t by_then = seen.states();
    ASSERT_TRUE(eventually([&] {
        client.read_into(seen);
        return seen.states() > by_then + 5;
    }));
    // If frames took long, its lease has run out since, and there is no command.
    const std::optional<OperatorCommand> command = served.operator_command();
    EXPECT_EQ(command.value_or(OperatorCommand{.burr = 1}).burr, 1U);
    EXPECT_TRUE(eventually([&, number = std::uint64_t{7}]() mutable {
        client.read_into(seen);
        client.send(input_frame(number++, {.burr = 0}, seen.sequence()));
        return served.operator_command() && served.operator_command()->burr == 0;
    })) << "what is now";

    RawClient clairvoyant(served.port());
    clairvoyant.send(input_frame(2, {.pedal = true}, 1'000'000));
    EXPECT_TRUE(clairvoyant.is_dropped());
}

TEST(StreamingServer, IsNotHeldUpByAClientThatNeverReads) {
    ServedBone served;
    served.start_carving();
    RawClient deaf(served.port());
    BoneLink link("127.0.0.1", served.port());
    EXPECT_TRUE(eventually([&] { return link.poll().checksums_verified >= 2; }));
    served.stop();  // cuts the deaf one off
    EXPECT_TRUE(reaches(link, LinkStatus::finished));
    EXPECT_EQ(checksum(*link.bone()), served.mirror_checksum());
    EXPECT_EQ(served.mirror_checksum(), checksum(served.bone()));
}

TEST(StreamingServer, KeepsNoBacklogForAClientThatReadsLate) {
    ServedBone served;
    served.start_carving();
    RawClient late(served.port());
    BoneLink link("127.0.0.1", served.port());
    ASSERT_TRUE(eventually([&] { return link.poll().frames >= 90; }));

    testing::Replica replica;
    std::uint64_t of_a_quick_one = 0;
    EXPECT_TRUE(eventually([&] {
        late.read_into(replica);
        of_a_quick_one = link.poll().frames;
        return replica.checksums() > 0;
    }));
    // However long the reading took: the server went on meanwhile, for both.
    EXPECT_GT(of_a_quick_one, replica.states() + 45U)
        << "what it missed comes as it now is, not frame by frame";
}

TEST(StreamingServer, TurnsAwayClientsBeyondItsLimit) {
    ServedBone served;
    std::vector<std::unique_ptr<RawClient>> clients;
    for (int i = 0; i < 32; ++i) {
        clients.push_back(std::make_unique<RawClient>(served.port()));
        testing::Replica replica;
        ASSERT_TRUE(eventually([&] {
            clients.back()->read_into(replica);
            return replica.bone().has_value();
        })) << "of client "
            << i;
    }
    RawClient one_more(served.port());
    EXPECT_TRUE(one_more.is_dropped());
    clients.clear();
    BoneLink link("127.0.0.1", served.port());
    EXPECT_TRUE(reaches(link, LinkStatus::live)) << "there is room again";
}

TEST(StreamingServer, LetsClientsInHoweverManyStrangersHangOnInSilence) {
    ServedBone served;
    std::vector<std::unique_ptr<RawClient>> strangers;
    for (int i = 0; i < 200; ++i)
        strangers.push_back(std::make_unique<RawClient>(served.port(), Says::nothing));
    BoneLink link("127.0.0.1", served.port());
    EXPECT_TRUE(reaches(link, LinkStatus::live));
    for (int i = 0; i < 200; ++i)
        strangers.push_back(std::make_unique<RawClient>(served.port(), Says::nothing));
    EXPECT_TRUE(strangers.front()->is_dropped());
    served.start_carving();
    EXPECT_TRUE(eventually([&] { return link.poll().checksums_verified >= 2; }));
    EXPECT_EQ(link.poll().connections, 1U) << "it was not the one to give way";
}

TEST(StreamingServer, SendsNothingButItsHelloToWhoSaysNone) {
    ServedBone served;
    RawClient silent(served.port(), Says::nothing);
    testing::Replica told;
    ASSERT_TRUE(eventually([&] {
        silent.read_into(told);
        return told.sequence() == 1;
    }));
    served.start_carving();
    RawClient client(served.port());
    testing::Replica seen;
    EXPECT_TRUE(eventually([&] {
        client.read_into(seen);
        return seen.checksums() > 1;
    }));
    silent.read_into(told);
    EXPECT_EQ(told.sequence(), 1U);
    EXPECT_GT(seen.bricks_of_last_state(), 0U);
    served.stop();
    EXPECT_TRUE(silent.is_dropped());
}

TEST(StreamingServer, RecordsAsIfForOneMoreClient) {
    const testing::TemporaryFolder folder;
    const Stamp began{std::chrono::seconds(1'700'000'000)};
    ServedBone served(0, false, 8, RecordTo{folder / "a.pcap", began});
    const std::uint64_t before = checksum(served.bone());
    {
        Playhead playhead(folder / "a.part.pcap");
        EXPECT_EQ(playhead.bone_checksum(), before) << "the snapshot is there before anything is carved";
    }
    served.start_carving();
    BoneLink link("127.0.0.1", served.port());
    EXPECT_TRUE(eventually([&] { return link.poll().checksums_verified >= 2; }));
    served.stop();

    Playhead playhead(folder / "a.pcap");
    bool has_goodbye = false;
    int states = 0;
    for (auto step = Playhead::Step::state; step != Playhead::Step::end;) {
        step = playhead.step(std::numeric_limits<double>::infinity());
        has_goodbye = has_goodbye || step == Playhead::Step::goodbye;
        states += step == Playhead::Step::state ? 1 : 0;
    }
    EXPECT_TRUE(has_goodbye);
    EXPECT_EQ(playhead.bone_checksum(), served.mirror_checksum());
    EXPECT_GE(playhead.counts().checksums_verified, 3U);
    // A state of a time that others had has one of its own, 0.1 ms after the last of them: many have, where
    // the loop gets no processor.
    EXPECT_GE(playhead.time_s(), playhead.tool()->time_s - 1e-5);
    EXPECT_LE(playhead.time_s(), playhead.tool()->time_s + 1e-4 * states);
}

TEST(StreamingServer, ShowsFramesWhenItIsToldToWhereTheSessionKeepsTheTime) {
    const testing::TemporaryFolder folder;
    const Bone bone = BoneBuilder::homogeneous({.size_voxels = {16, 16, 16}}, 1.0, false).build();
    ChangeQueue changes(16, bone.shared_content());
    TripleBuffer<ToolState> tool;
    LiveSession shown(tool, changes);
    Scene scene;
    scene.burrs = {Burr{}};
    StreamingServer server(
        {.listens = false, .paced_by_session = true, .record = RecordTo{folder / "a.pcap", Stamp{}}},
        session_info(scene, false, 3.3, "0.0.test"), bone, shown);
    server.start();
    for (int i = 0; i < 10; ++i) {
        tool.back().time_s = i;
        tool.publish();
        server.show_frame();
    }
    server.stop();
    ASSERT_TRUE(server.recording());
    EXPECT_EQ(server.recording()->frames, 3U + 10 + 1) << "hello, snapshot without bricks; the end";
    EXPECT_EQ(server.recording()->error, "");
    EXPECT_EQ(outline_of(folder / "a.pcap").duration_s, 9.0);
}

TEST(StreamingServer, IgnoresOperatorsWhenItHasNoUseForThem) {
    ServedBone served;
    RawClient eager(served.port());
    eager.send(input_frame(2, {.pedal = true}));
    BoneLink link("127.0.0.1", served.port());
    ASSERT_TRUE(reaches(link, LinkStatus::live));
    EXPECT_FALSE(link.session()->accepts_operator);
    std::thread stopping([&] { served.stop(); });
    EXPECT_TRUE(eager.is_dropped()) << "only at the end";
    stopping.join();
}

}  // namespace
}  // namespace osteomill
