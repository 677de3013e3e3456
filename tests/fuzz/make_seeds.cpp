// Writes the seed corpus with the programs' own encoders.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "common/recording/pcap_file.h"
#include "common/wire/distance_messages.h"
#include "common/wire/frame.h"
#include "common/wire/sealed_frame.h"
#include "common/wire/structure_messages.h"
#include "haptic_server/streaming/outgoing_frames.h"
#include "tests/fuzz/image_seeds.h"
#include "tests/fuzz/small_session.h"
#include "tests/support/packed.h"

namespace osteomill::fuzz {

namespace {

void write_file(const std::filesystem::path& file, const std::string& bytes) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
}

std::string message_of(const std::string& stream) {
    FrameDecoder decoder;
    decoder.append({reinterpret_cast<const std::uint8_t*>(stream.data()), stream.size()});
    const auto message = decoder.next().value();
    return {message.begin(), message.end()};
}

/// The frames of a session in which a run of voxels is milled, each behind its length.
std::vector<std::string> session_frames(const Bone& bone, bool with_ticks = false) {
    BoneReplica mirror(bone);
    FramePackers packers;
    SessionInfo info = small_session_info();
    info.holds_ticks = with_ticks;
    OutgoingFrames outgoing(to_message(info), mirror, packers);
    std::vector<std::string> frames;
    const auto drain = [&] {
        while (auto frame = outgoing.next()) frames.push_back(*std::move(frame));
    };
    drain();
    for (int i = 0; i < 4; ++i) {
        const std::size_t first = 16 * static_cast<std::size_t>(i);
        ByteBrick left{};
        for (std::size_t k = 0; k < 9; ++k) left[first + k] = static_cast<std::uint8_t>(90 - 10 * k);
        if (mirror.apply({0, VoxelMask().set_run(first, 9)}, left)) outgoing.note(mirror.take_changes());
        for (int k = 0; k < 40 && with_ticks; ++k)
            outgoing.note_tick({.time_s = 0.04 * i + 0.001 * k,
                                .hand_mm = {0.1 * i, 0.01 * k, 0.0},
                                .force_n = {0.1 * i, 0.0, -0.001 * k},
                                .spindle_on = k > 20,
                                .fault = static_cast<std::uint8_t>(i),
                                .burr = static_cast<std::size_t>(i % 2),
                                .shank_torque_n_mm = glm::dvec3(0.0, -0.1 * i, 0.001 * k)});
        if (i == 2 && with_ticks) outgoing.note_missed_ticks(3);
        outgoing.request_state({.tool = {.time_s = 0.04 * i,
                                         .burr_position_mm = {0.1 * i, 0.0, 0.0},
                                         .force_n = {0.1 * i, 0.0, -0.2},
                                         .burr = static_cast<std::size_t>(i % 2),
                                         .spindle_on = true,
                                         .removed_mm3 = 0.01 * i,
                                         .fault = i == 2 ? "the device is lost" : ""}},
                               i % 2 == 1);
        drain();
    }
    outgoing.finish("the session has ended");
    drain();
    return frames;
}

std::string joined(const std::vector<std::string>& frames, std::size_t first = 0) {
    std::string stream;
    for (std::size_t i = first; i < frames.size(); ++i) stream += frames[i];
    return stream;
}

/// A small bone with all channels that a bone may have.
Bone varied_bone() {
    const Grid grid{.size_voxels = {20, 16, 16}, .spacing_mm = 0.2, .origin_mm = {1.0, -2.0, 3.0}};
    auto builder = BoneBuilder::heterogeneous(grid, 0.02, true);
    ByteBrick fraction{};
    ByteBrick stiffness{};
    ByteBrick tissue{};
    for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel) {
        fraction[voxel] = static_cast<std::uint8_t>(voxel % 7 == 0 ? 255 : 100);
        stiffness[voxel] = static_cast<std::uint8_t>(voxel / 64);
        tissue[voxel] = voxel < 2048 ? 2 : 0;
    }
    builder.add_brick({0, 0, 0}, fraction, &stiffness, &tissue);
    return std::move(builder).build();
}

void write_recording(const std::filesystem::path& file,
                     const std::vector<std::vector<std::string>>& sessions) {
    std::filesystem::create_directories(file.parent_path());
    PacketWriter packets(file);
    Stamp stamp{std::chrono::seconds(1'700'000'000)};
    for (const auto& frames : sessions)
        for (const std::string& frame : frames) {
            const std::string message = message_of(frame);
            packets.write(stamp, with_recorded_time(
                                     {reinterpret_cast<const std::uint8_t*>(message.data()), message.size()},
                                     stamp.time_since_epoch().count()));
            stamp += std::chrono::milliseconds(33);
        }
}

v2::ClientFrame operator_input(double x_mm, std::uint32_t burr) {
    static std::uint64_t number = 0;
    v2::ClientFrame frame;
    v2::OperatorInput& input = *frame.mutable_operator_input();
    input.mutable_hand_target_mm()->set_x(x_mm);
    input.mutable_spindle_axis()->set_z(2.0);
    input.set_pedal(true);
    input.set_burr(burr);
    input.set_number(++number);
    input.set_answers_state(5);  // the first that a session of this bone sends
    return frame;
}

v2::ClientFrame comparison(const Bone& copy) {
    v2::ClientFrame frame;
    *frame.mutable_compare_bone() = *DifferenceSearch(copy).next(copy, RunningChecksum(copy));
    return frame;
}

v2::ClientFrame hello() {
    v2::ClientFrame frame;
    frame.mutable_hello()->set_protocol_major(protocol_major);
    return frame;
}

v2::ClientFrame viewpoint(float qw) {
    v2::ClientFrame frame;
    v2::Viewpoint& view = *frame.mutable_viewpoint();
    view.mutable_eye_mm()->set_y(-80.0);
    view.set_qw(qw);
    view.set_field_of_view_deg(34.0f);
    return frame;
}

v2::ClientFrame goodbye() {
    v2::ClientFrame frame;
    frame.mutable_goodbye()->set_reason("enough");
    return frame;
}

std::string numbered(std::vector<v2::ClientFrame> frames) {
    std::string stream;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        frames[i].set_sequence(i + 1);
        append_frame(frames[i], stream);
    }
    return stream;
}

/// A frame behind the four of the client target's own session, not sealed: the fuzzer cannot seal either.
std::string state_of(std::uint64_t sequence, v2::StateFrame state) {
    v2::ServerFrame frame;
    frame.set_sequence(sequence);
    *frame.mutable_state() = std::move(state);
    std::string stream;
    append_frame(frame, stream);
    return stream;
}

v2::StateFrame changed(BrickIndex brick, std::size_t first, const std::string& fractions) {
    v2::StateFrame state;
    *state.mutable_tool() = to_message(ToolState{});
    ChangedBrick changed{.change = {brick, VoxelMask().set_run(first, fractions.size())}};
    std::ranges::copy(fractions, changed.fractions.begin() + static_cast<std::ptrdiff_t>(first));
    *state.mutable_changes() = testing::packed({changed});
    return state;
}

std::string structure_of(std::uint64_t sequence) {
    const Grid grid = small_bone().grid();
    const Structure nerve{0,
                          StructureMask(grid, {{0, VoxelMask().set_run(32, 16)}, {4, VoxelMask().set(3)}})};
    v2::ServerFrame frame;
    frame.set_sequence(sequence);
    *frame.mutable_structure_bricks() = structure_pieces(std::span(&nerve, 1)).front();
    std::string stream;
    append_frame(frame, stream);
    return stream;
}

v2::StateFrame near_structure() {
    v2::StateFrame state;
    *state.mutable_tool() = to_message(ToolState{});
    *state.add_distances() = to_message(StructureDistance{
        .tissue = 0, .distance_mm = 0.25, .touches_so_far = 1, .first_touch_s = 0.5, .touched_s = 0.1});
    return state;
}

void write_seeds(const std::filesystem::path& folder) {
    const Bone bone = small_bone();
    const auto frames = session_frames(bone);
    const auto varied = session_frames(varied_bone());
    const auto ticks = session_frames(bone, true);

    write_file(folder / "frame_decoder/session", '\x07' + joined(frames));
    write_file(folder / "frame_decoder/client", '\x40' + numbered({operator_input(1.0, 0), goodbye()}));
    write_file(folder / "frame_decoder/too_long", std::string("\x00\xff\xff\xff\x01 too long", 14));
    write_file(folder / "frame_decoder/padded", std::string("\x43\x81\x00 padded", 10));

    Bone carved = bone;
    carved.fractions(0)[5] = 0;
    write_file(folder / "server_session/operator",
               '\x8f' + numbered({hello(), operator_input(1.0, 0), operator_input(-3.5, 1), goodbye()}));
    write_file(folder / "server_session/comparison",
               '\xff' + numbered({hello(), comparison(carved), operator_input(0.0, 1), comparison(bone)}));
    write_file(folder / "server_session/hello",
               '\x87' + numbered({hello(), hello(), operator_input(1.0, 0), comparison(bone), goodbye()}));
    write_file(folder / "server_session/viewpoint",
               '\x87' + numbered({hello(), viewpoint(1.0f), viewpoint(0.5f), goodbye()}));
    write_file(folder / "server_session/slow_reader",
               '\x10' + numbered({hello(), operator_input(0.0, 1), goodbye()}));
    write_file(folder / "server_session/tls", std::string("\xff\x16\x03\x01\x02", 5));

    write_file(folder / "client_session/session", '\0' + joined(frames));
    write_file(folder / "client_session/varied", '\0' + joined(varied));
    write_file(folder / "client_session/ticks", '\0' + joined(ticks));
    write_file(folder / "client_session/changes", '\x01' + state_of(5, changed(0, 3, "\x05\x04\x03")) +
                                                      state_of(6, changed(5, 16, "\x05\x04\x03")));
    write_file(folder / "client_session/bone_regained", '\x01' + state_of(5, changed(0, 0, "\xff")));
    write_file(folder / "client_session/outside_grid", '\x01' + state_of(5, changed(5, 15, "\x01")));
    v2::StateFrame answer = changed(0, 0, "\x01");
    answer.mutable_comparison()->add_differing_part(0);
    v2::StateFrame doubtful = changed(0, 7, "\x02");
    doubtful.set_bone_checksum(1);
    write_file(folder / "client_session/structure", '\x01' + structure_of(5) + state_of(6, near_structure()));
    write_file(folder / "client_session/repair", '\x01' + state_of(5, doubtful) + state_of(6, answer));

    write_recording(folder / "recording/session.pcap", {frames});
    write_recording(folder / "recording/varied.pcap", {varied});
    write_recording(folder / "recording/ticks.pcap", {ticks});
    write_recording(folder / "recording/joined.pcap", {frames, varied});

    write_image_seeds(folder);
}

}  // namespace

}  // namespace osteomill::fuzz

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "make_fuzz_seeds FOLDER\n";
        return 2;
    }
    osteomill::fuzz::write_seeds(argv[1]);
}
