// A recording made as by a server, of a bone that is carved at random, and its known contents.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/files/atomic_file.h"
#include "common/files/session_file.h"
#include "common/recording/pcap_file.h"
#include "common/wire/scene_messages.h"
#include "common/wire/structure_messages.h"
#include "haptic_server/streaming/session_recorder.h"
#include "tests/support/random_carving.h"
#include "tests/support/replica_sink.h"
#include "tests/support/speckled_bone.h"

namespace osteomill::testing {

struct MadeRecordingOptions {
    int states = 200;
    std::uint32_t seed = 4;
    bool ends = true;  ///< with a goodbye
    std::uint32_t protocol_major = osteomill::protocol_major;
    std::vector<Structure> structures{};
    /// Their distances in state i; no function: none.
    std::function<std::vector<StructureDistance>(int i)> distances{};
    /// The controls that come with state i.
    std::function<std::vector<ControlEvent>(int i)> events{};
};

struct MadeRecording {
    static constexpr double period_s = 0.05;

    Bone before;
    Bone after;
    std::vector<std::uint64_t> checksum_after_state;  ///< state i is at i * period_s

    double duration_s() const { return period_s * static_cast<double>(checksum_after_state.size() - 1); }
};

inline SessionInfo recorded_session_info() {
    return {.scene_name = "test scene",
            .server_version = "0.0.test",
            .burrs = {Burr{.name = "round 1.5", .diameter_mm = 1.5}, Burr{.name = "round 5"}},
            .tissues = {Tissue{.label = 2, .name = "nerve", .is_protected = true}},
            .force_limit_n = 3.3};
}

inline MadeRecording make_recording(const std::filesystem::path& file,
                                    const MadeRecordingOptions& options = {}) {
    std::mt19937 random(options.seed);
    Bone bone = make_speckled_bone(random, {.grid = {.size_voxels = {64, 48, 32}}});
    MadeRecording made{bone, bone, {}};
    BoneReplica mirror(bone);
    ReplicaSink to_mirror(mirror);
    SessionInfo session = recorded_session_info();
    session.protocol_major = options.protocol_major;
    const Stamp began{std::chrono::seconds(1'700'000'000) + std::chrono::nanoseconds(7)};
    const std::vector<v2::StructureBricks> structures = structure_pieces(options.structures);
    std::optional<SessionRecorder> recorder(std::in_place, RecordTo{.file = file, .began = began},
                                            to_message(session), mirror, structures);
    SessionState state;
    ToolState& tool = state.tool;
    for (int i = 0; i < options.states; ++i) {
        if (i > 0)
            for (int run = 0; run < 10; ++run) carve_somewhere(made.after, random, to_mirror);
        recorder->note(mirror.take_changes());
        tool.time_s = MadeRecording::period_s * i;
        tool.spindle_on = i % 2 == 1;
        tool.burr = 1;
        if (options.distances) state.distances = options.distances(i);
        if (options.events) state.events = options.events(i);
        recorder->record(state, true);
        made.checksum_after_state.push_back(mirror.checksum());
    }
    state.events.clear();
    if (options.ends) recorder->finish(state, "the end");
    recorder.reset();
    if (!options.ends) std::filesystem::rename(part_of(file), file);
    return made;
}

inline std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

/// Joins recordings as `mergecap -a` would: the second's packets behind the first's.
inline void join(const std::filesystem::path& first, const std::filesystem::path& second,
                 const std::filesystem::path& joined) {
    constexpr std::size_t file_header_bytes = 24;
    write_bytes(joined, bytes_of(first) + bytes_of(second).substr(file_header_bytes));
}

/// Changes a byte within the frame that lies so many frames before the last.
inline void spoil(const std::filesystem::path& file, std::size_t before_last) {
    std::vector<std::uint64_t> frame_at;
    PacketReader packets(file);
    constexpr std::uint64_t packet_header_bytes = 16;
    while (const auto packet = packets.next())
        frame_at.push_back(packet->place.offset_bytes + packet_header_bytes);
    std::string bytes = bytes_of(file);
    char& byte = bytes[frame_at[frame_at.size() - 1 - before_last] + 5];
    byte = static_cast<char>(byte + 1);
    write_bytes(file, bytes);
}

}  // namespace osteomill::testing
