#include "common/recording/playhead.h"

#include <gmock/gmock.h>

#include <limits>

#include "common/recording/pcap_file.h"
#include "common/recording/recording_reader.h"
#include "common/wire/frame.h"
#include "common/wire/sealed_frame.h"
#include "tests/support/made_recording.h"
#include "tests/support/message_of.h"
#include "tests/support/packed.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::MadeRecording;

constexpr double for_ever = std::numeric_limits<double>::infinity();

/// Goes to the end; returns the error that stops it, or nothing.
std::string complaint(const std::filesystem::path& file) {
    return testing::message_of<RecordingError>([&] {
        Playhead playhead(file);
        while (playhead.step(for_ever) != Playhead::Step::end) {
        }
    });
}

class PlayheadTest : public ::testing::Test {
  protected:
    testing::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "a.pcap";
};

TEST_F(PlayheadTest, FollowsTheBoneFromTheFirstToTheLast) {
    const MadeRecording made = testing::make_recording(file_);
    Playhead playhead(file_);
    EXPECT_EQ(playhead.session().scene_name, "test scene");
    EXPECT_EQ(playhead.session().server_version, "0.0.test");
    EXPECT_EQ(playhead.session().protocol_minor, protocol_minor);
    EXPECT_EQ(playhead.session().burrs.size(), 2U);
    EXPECT_EQ(playhead.bone_checksum(), checksum(made.before));
    EXPECT_FALSE(playhead.tool());
    while (playhead.step(for_ever) != Playhead::Step::goodbye) {
    }
    EXPECT_EQ(playhead.step(for_ever), Playhead::Step::end);
    EXPECT_EQ(playhead.bone_checksum(), checksum(made.after));
    EXPECT_EQ(checksum(playhead.bone()), checksum(made.after));
    EXPECT_EQ(playhead.counts().states, made.checksum_after_state.size());
    EXPECT_EQ(playhead.counts().checksums_verified, made.checksum_after_state.size());
    EXPECT_NEAR(playhead.time_s(), made.duration_s(), 1e-6);
    EXPECT_NEAR(outline_of(file_).duration_s, made.duration_s(), 1e-6);
    EXPECT_FALSE(playhead.is_truncated());
}

TEST_F(PlayheadTest, StopsBeforeWhatIsLater) {
    const MadeRecording made = testing::make_recording(file_);
    Playhead playhead(file_);
    while (playhead.step(2.02) != Playhead::Step::nothing_due) {
    }
    EXPECT_NEAR(playhead.time_s(), 2.0, 1e-6);
    EXPECT_EQ(playhead.bone_checksum(), made.checksum_after_state[40]);
    EXPECT_EQ(playhead.tool()->time_s, 2.0);
    EXPECT_NEAR(*playhead.next_time_s(), 2.05, 1e-6);
}

TEST_F(PlayheadTest, GoesFromOneSessionToTheNextOfAJoinedRecording) {
    const MadeRecording first = testing::make_recording(file_, {.states = 50, .ends = false});
    const MadeRecording second = testing::make_recording(folder_ / "b.pcap", {.states = 30, .seed = 9});
    testing::join(file_, folder_ / "b.pcap", folder_ / "both.pcap");
    Playhead playhead(folder_ / "both.pcap");
    while (playhead.step(for_ever) == Playhead::Step::state)
        EXPECT_TRUE(!playhead.next_begins_session() || playhead.bone_checksum() == checksum(first.after));
    EXPECT_EQ(playhead.bone_checksum(), checksum(second.before));
    while (playhead.step(for_ever) != Playhead::Step::end) {
    }
    EXPECT_EQ(playhead.bone_checksum(), checksum(second.after));
    EXPECT_NEAR(playhead.time_s(), first.duration_s() + second.duration_s(), 1e-6);
    EXPECT_NEAR(outline_of(folder_ / "both.pcap").duration_s, playhead.time_s(), 1e-6);
}

TEST_F(PlayheadTest, IsReadableUpToTheLastWholeFrameWhereverItIsTorn) {
    const MadeRecording made = testing::make_recording(file_, {.states = 40});
    const std::string bytes = testing::bytes_of(file_);
    std::mt19937 random(3);
    for (int i = 0; i < 50; ++i) {
        const auto torn = folder_ / "torn.pcap";
        testing::write_bytes(torn, bytes.substr(0, bytes.size() - 1 - random() % 4000));
        Playhead playhead(torn);
        while (playhead.step(for_ever) != Playhead::Step::end) {
        }
        const std::size_t states = playhead.counts().states;
        EXPECT_GT(states, 0U);
        EXPECT_EQ(playhead.bone_checksum(),
                  made.checksum_after_state[std::min(states, made.checksum_after_state.size()) - 1]);
    }
    testing::write_bytes(folder_ / "torn.pcap", bytes.substr(0, 60'000));
    EXPECT_THAT(complaint(folder_ / "torn.pcap"), HasSubstr("ends before the bone is complete"));
}

TEST_F(PlayheadTest, FindsEveryByteThatWasChanged) {
    testing::make_recording(file_, {.states = 20});
    const std::string bytes = testing::bytes_of(file_);
    PacketReader packets(file_);
    std::mt19937 random(6);
    for (auto packet = packets.next(); packet; packet = packets.next()) {
        std::string changed = bytes;
        const std::size_t at = packet->place.offset_bytes + 16 + random() % packet->message.size();
        changed[at] = static_cast<char>(changed[at] ^ (1 << random() % 8));
        testing::write_bytes(folder_ / "changed.pcap", changed);
        EXPECT_THAT(complaint(folder_ / "changed.pcap"),
                    HasSubstr("packet " + std::to_string(packet->place.number) + " at byte "));
    }
}

TEST_F(PlayheadTest, FindsEveryBitThatWasChangedInTheHeaderOfAPacket) {
    constexpr std::size_t header_bytes = 16;
    testing::make_recording(file_, {.states = 4});
    const std::string bytes = testing::bytes_of(file_);
    std::vector<std::size_t> packet_at;
    PacketReader packets(file_);
    while (const auto packet = packets.next()) packet_at.push_back(packet->place.offset_bytes);
    packet_at.pop_back();  // a length that goes beyond the file's end cannot be told from a torn end there
    for (std::size_t number = 1; number <= packet_at.size(); ++number)
        for (std::size_t bit = 0; bit < 8 * header_bytes; ++bit) {
            std::string changed = bytes;
            char& byte = changed[packet_at[number - 1] + bit / 8];
            byte = static_cast<char>(byte ^ (1 << bit % 8));
            testing::write_bytes(folder_ / "changed.pcap", changed);
            EXPECT_THAT(complaint(folder_ / "changed.pcap"),
                        HasSubstr("packet " + std::to_string(number) + " at byte "))
                << "bit " << bit;
        }
}

TEST_F(PlayheadTest, RefusesInOneLineWhatItCannotUnderstand) {
    testing::make_recording(file_, {.states = 2, .protocol_major = protocol_major + 1});
    EXPECT_THAT(complaint(file_), AllOf(HasSubstr("packet 1"), HasSubstr("recorded with protocol 3"),
                                        HasSubstr("use Osteomill 0.0.test or later")));

    // Cut out of a longer one: without the first packet, and without one in the middle.
    testing::make_recording(file_, {.states = 10});
    const std::string bytes = testing::bytes_of(file_);
    PacketReader packets(file_);
    const std::size_t second = (packets.next(), packets.place().offset_bytes);
    testing::write_bytes(file_, bytes.substr(0, 24) + bytes.substr(second));
    EXPECT_THAT(complaint(file_), HasSubstr("beginning was cut off"));

    testing::write_bytes(file_, bytes);
    PacketReader again(file_);
    std::vector<std::size_t> offsets;
    while (const auto packet = again.next()) offsets.push_back(packet->place.offset_bytes);
    const std::size_t middle = offsets.size() - 4;
    testing::write_bytes(file_, bytes.substr(0, offsets[middle]) + bytes.substr(offsets[middle + 1]));
    EXPECT_THAT(complaint(file_), HasSubstr(" came after "));
}

TEST_F(PlayheadTest, RefusesChangesThatDoNotFitTheBoneHoweverWellSealed) {
    testing::make_recording(file_, {.states = 2, .ends = false});
    std::uint64_t sequence = 0;
    PacketReader packets(file_);
    while (packets.next()) ++sequence;
    v2::ServerFrame frame;
    frame.set_sequence(sequence + 1);
    *frame.mutable_state()->mutable_tool() = to_message(ToolState{});
    const auto complaint_about = [&](const ChangedBrick& changed) {
        *frame.mutable_state()->mutable_changes() = testing::packed({changed});
        std::string stream;
        append_sealed_frame(frame, stream);
        FrameDecoder decoder;
        decoder.append({reinterpret_cast<const std::uint8_t*>(stream.data()), stream.size()});
        const auto message = decoder.next();
        PacketWriter writer(folder_ / "tail.pcap");
        writer.write(Stamp{}, with_recorded_time(*message, 0));
        testing::join(file_, folder_ / "tail.pcap", folder_ / "hostile.pcap");
        return complaint(folder_ / "hostile.pcap");
    };
    EXPECT_THAT(complaint_about({.change = {.brick = 4'000'000'000U}}),
                AllOf(HasSubstr("packet "), HasSubstr("outside the grid")));
    const Bone bone = Playhead(file_).bone();
    BrickIndex empty = 0;
    while (bone.slot(empty) != BoneContent::no_slot) ++empty;
    EXPECT_THAT(complaint_about({.change = {.brick = empty}}), HasSubstr("no bone is stored there"));
    ChangedBrick regained{.change = {bone.content().brick_of_slot.front(), VoxelMask().set_all()}};
    regained.fractions.fill(255);
    EXPECT_THAT(complaint_about(regained), HasSubstr("the bone differs from the one recorded"));
}

}  // namespace
}  // namespace osteomill
