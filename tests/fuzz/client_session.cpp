#include <optional>
#include <string>

#include "common/wire/ct_pieces.h"
#include "common/wire/frame.h"
#include "common/wire/sealed_frame.h"
#include "common/wire/session_receiver.h"
#include "render_client/link/verified_replica.h"
#include "tests/fuzz/small_session.h"
#include "tests/fuzz/targets.h"

namespace osteomill::fuzz {

namespace {

/// The client of a session without the network: the work of ServerConnection and BoneLink on a frame.
class Client {
  public:
    /// Nothing is to be expected behind an error.
    std::optional<WireError> take(Bytes message) {
        auto opened = open_frame(message);
        if (auto* frame = std::get_if<v2::ServerFrame>(&opened)) return take(std::move(*frame));
        // The fuzzer cannot seal a frame that it has changed, so nothing behind the seal would be tested.
        v2::ServerFrame unsealed;
        if (!parse_message(message, unsealed)) return std::get<WireError>(std::move(opened));
        return take(std::move(unsealed));
    }
    std::optional<WireError> take(v2::ServerFrame frame) {
        auto event = receiver_.take(std::move(frame));
        if (auto* error = std::get_if<WireError>(&event)) return std::move(*error);
        return std::visit([this](auto&& what) { return take(std::move(what)); },
                          std::get<SessionEvent>(std::move(event)));
    }

  private:
    using Outcome = std::optional<WireError>;
    Outcome take(SnapshotGoesOn) {
        require(receiver_.bricks_received() <= receiver_.bricks_announced(),
                "more bricks came than were announced");
        return {};
    }
    Outcome take(SessionInfo info) {
        require(!info.burrs.empty(), "a session without a burr");
        copy_.begin(std::move(info));
        return {};
    }
    Outcome take(CtPieceArrived arrived) {
        auto taken = ct_.take(*arrived.piece);
        const auto* ct = std::get_if<std::shared_ptr<const CtVolume>>(&taken);
        if (ct != nullptr && *ct) (void)(*ct)->hu_at((*ct)->grid.origin_mm);
        return {};
    }
    Outcome take(const StructureArrived& arrived) {
        if (!arrived.structure) return {};
        require(arrived.structure->tissue < copy_.session()->tissues.size(), "a structure of no tissue");
        require(arrived.structure->mask.grid() == copy_.bone()->grid(), "a structure of another grid");
        return {};
    }
    Outcome take(BoneArrived arrived) {
        copy_.take(std::move(arrived));
        require_sound();
        return {};
    }
    Outcome take(StateArrived arrived) {
        auto outcome = copy_.take(arrived);
        for (const BrickChange& change : copy_.take_changes())
            require(copy_.bone()->slot(change.brick) != BoneContent::no_slot,
                    "a brick changed that is not stored");
        require_sound();
        if (auto* error = std::get_if<WireError>(&outcome)) return std::move(*error);
        require(arrived.state.tool.burr < copy_.session()->burrs.size(), "a burr that is not there");
        if (const auto& question = std::get<0>(outcome)) require_answerable(*question);
        return {};
    }
    Outcome take(SaidGoodbye) { return WireError{"over"}; }
    Outcome take(SpeaksOtherProtocol other) {
        require(other.major != protocol_major, "its own protocol is strange to the client");
        return WireError{"over"};
    }

    void require_sound() const {
        const Bone& bone = *copy_.bone();
        require(copy_.checksum() == checksum(bone), "the running checksum is not that of the voxels");
        const Grid& grid = bone.content().grid;
        for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
            const glm::ivec3 first = brick_edge_voxels * brick_position(bone.content().size_bricks,
                                                                        bone.content().brick_of_slot[slot]);
            if (contains(grid, first + (brick_edge_voxels - 1))) continue;
            const auto fractions = bone.fractions(static_cast<std::int32_t>(slot));
            for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel)
                require(fractions[voxel] == 0 || contains(grid, first + voxel_in_brick(voxel)),
                        "there is bone outside the grid");
        }
    }
    void require_answerable(const v2::CompareBone& request) const {
        v2::ClientFrame frame;
        frame.set_sequence(~std::uint64_t{0});
        *frame.mutable_compare_bone() = request;
        require(frame.ByteSizeLong() <= largest_client_frame_bytes, "a request that a server would refuse");
        const auto compared = compare_bone(request, *copy_.bone(), RunningChecksum(*copy_.bone()));
        require(std::holds_alternative<ComparedBone>(compared), "a request that a server would refuse");
        require(std::get<ComparedBone>(compared).answer.differing_part().empty(), "a copy unlike itself");
    }

    CtAssembler ct_;
    SessionReceiver receiver_{Gaps::reported};
    VerifiedReplica copy_;
};

/// The frames that bring a client the small bone; nothing is random about them.
std::vector<v2::ServerFrame> frames_to_live() {
    const Bone bone = small_bone();
    std::vector<v2::ServerFrame> frames(4);
    *frames[0].mutable_hello() = to_message(small_session_info());
    *frames[1].mutable_snapshot_begin() = snapshot_begin(bone);
    *frames[2].mutable_snapshot_bricks() = SnapshotPacker().pack(bone, 0);
    frames[3].mutable_snapshot_end()->set_checksum(checksum(bone));
    for (std::size_t i = 0; i < frames.size(); ++i) frames[i].set_sequence(i + 1);
    return frames;
}

}  // namespace

void client_session(Bytes input) {
    if (input.empty()) return;
    Client client;
    // Half of the time the fuzzer need not make a snapshot whose checksum holds.
    if (input[0] % 2 == 1) {
        static const std::vector<v2::ServerFrame> to_live = frames_to_live();
        for (const v2::ServerFrame& frame : to_live)
            require(!client.take(frame), "a session of our own is refused");
    }
    FrameDecoder decoder;
    decoder.append(input.subspan(1));
    while (const auto message = decoder.next())
        if (const auto error = client.take(*message)) {
            require(!error->line.empty() && error->line.find('\n') == std::string::npos,
                    "a complaint that is not one line");
            return;
        }
}

}  // namespace osteomill::fuzz
