#include "render_client/link/bone_link.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include "common/wire/ct_pieces.h"
#include "common/wire/scene_messages.h"
#include "common/words/translation.h"
#include "render_client/link/link_meters.h"
#include "render_client/link/server_connection.h"
#include "render_client/link/verified_replica.h"

namespace osteomill {

class BoneLink::Impl {
  public:
    Impl(std::string host, std::uint16_t port, const std::optional<std::filesystem::path>& record,
         const std::optional<TlsFiles>& tls)
        : connection(std::move(host), port, record, tls) {}

    LinkUpdate poll() {
        LinkUpdate update;
        std::size_t taken = 0;
        for (; taken < LinkQueue::capacity; ++taken) {
            std::optional<LinkEvent> event = connection.events().pop();
            if (!event) break;
            std::visit([&](auto& what) { take(std::move(what), update); }, *event);
        }
        if (taken > 0) connection.resume();
        complete(update);
        // Events that waited in the queue were no silence, however long nobody polled.
        if (taken == 0)
            update.silent_s =
                std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch() -
                                              connection.counters().heard.load())
                    .count();
        return update;
    }

    ServerConnection connection;
    VerifiedReplica replica;

  private:
    void take(SessionBegan began, LinkUpdate&) {
        replica.begin(std::move(began.info));
        session_number_ = began.number;
        controls_ = {};
        distances_.clear();
        delay_meter_ = {};
        delay_.reset();
    }

    void take(BoneArrived arrived, LinkUpdate& update) {
        if (auto before = replica.take(std::move(arrived)))
            connection.discard(std::make_shared<BoneReplica>(*std::move(before)));
        update.bone_replaced = true;
        update.structures.clear();
    }

    void take(const CtPieceArrived& arrived, LinkUpdate& update) {
        auto taken = ct_.take(*arrived.piece);
        if (auto* ct = std::get_if<std::shared_ptr<const CtVolume>>(&taken)) {
            if (*ct) update.ct = std::move(*ct);
            return;
        }
        // The bone is no worse for it.
        line_ = std::get<WireError>(taken).line;
    }

    void take(StructureArrived arrived, LinkUpdate& update) {
        if (arrived.structure) update.structures.push_back(*std::move(arrived.structure));
    }

    void take(StatusChanged changed, LinkUpdate&) {
        status_ = changed.status;
        line_ = std::move(changed.line);
    }

    void take(StateArrived arrived, LinkUpdate& update) {
        const auto outcome = replica.take(arrived);
        if (const auto* error = std::get_if<WireError>(&outcome)) {
            status_ = LinkStatus::lost;
            line_ = trf("{}; asking for the bone afresh", error->line);
            connection.events().disown();
            connection.reconnect();
            return;
        }
        SessionState& state = arrived.state;
        update.tool = std::move(state.tool);
        update.events.insert(update.events.end(), state.events.begin(), state.events.end());
        controls_ = state.status;
        distances_ = std::move(state.distances);
        if (const auto& question = std::get<0>(outcome)) connection.send(*question, session_number_);
    }

    void complete(LinkUpdate& update) {
        const LinkCounters& counters = connection.counters();
        update.changes = replica.take_changes();
        if (update.bone_replaced) update.changes.clear();
        if (update.tool && update.tool->taken_unix_ns != 0)
            delay_ = delay_meter_.update(update.tool->taken_unix_ns, std::chrono::system_clock::now());
        update.delay = delay_;
        update.status = status_;
        if (status_ == LinkStatus::live) update.controls = controls_;
        update.distances = distances_;
        update.status_line = replica.is_being_repaired()
                                 ? "the bone differs from the server's; asking for the bricks that differ"
                                 : line_;
        update.recording_error = connection.recording_error();
        if (status_ == LinkStatus::receiving_snapshot) {
            update.snapshot_bricks = counters.snapshot_bricks;
            update.snapshot_bricks_total = counters.snapshot_bricks_total;
        }
        const VerifiedReplica::Counters& copied = replica.counters();
        update.frames = copied.frames;
        update.checksums_verified = copied.verified;
        update.checksum_mismatches = copied.mismatches;
        update.rejected_frames = copied.rejected_frames + counters.rejected_frames;
        update.connections = counters.connections;
        update.repairs = copied.repairs;
        update.bricks_repaired = copied.bricks_repaired;
        const auto now = std::chrono::steady_clock::now();
        update.frames_per_s = frame_rate_.update(copied.frames, now);
        update.bytes_per_s = byte_rate_.update(counters.bytes, now);
    }

    LinkStatus status_ = LinkStatus::connecting;
    std::string line_;
    SessionStatus controls_;
    std::vector<StructureDistance> distances_;
    CtAssembler ct_;
    std::uint64_t session_number_ = 0;
    DelayMeter delay_meter_;
    std::optional<DelayMeter::Delay> delay_;
    RateMeter frame_rate_;
    RateMeter byte_rate_;
};

BoneLink::BoneLink(std::string host, std::uint16_t port, const std::optional<std::filesystem::path>& record,
                   const std::optional<TlsFiles>& tls)
    : impl_(std::make_unique<Impl>(std::move(host), port, record, tls)) {}
BoneLink::~BoneLink() = default;
LinkUpdate BoneLink::poll() {
    return impl_->poll();
}
const Bone* BoneLink::bone() const {
    return impl_->replica.bone();
}
const SessionInfo* BoneLink::session() const {
    return impl_->replica.session();
}
void BoneLink::send_operator(const OperatorCommand& command) {
    impl_->connection.send(command);
}
void BoneLink::ask_for_ct() {
    impl_->connection.ask_for_ct();
}
void BoneLink::connect_to(const ListenAddress& server) {
    impl_->connection.connect_to(server.address, server.port);
}
void BoneLink::leave_alone(bool leaves_alone) {
    impl_->connection.leave_alone(leaves_alone);
}
void BoneLink::send_control(const SessionControl& control) {
    impl_->connection.send(control);
}
void BoneLink::send_view(const Viewpoint& view) {
    impl_->connection.send(view);
}
std::optional<ToolState> BoneLink::newest_tool() const {
    return impl_->connection.newest_tool();
}
std::string BoneLink::finish() {
    return impl_->connection.finish_recording();
}

}  // namespace osteomill
