#include "render_client/link/bone_link.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "common/wire/bone_follower.h"
#include "common/wire/scene_messages.h"
#include "render_client/link/bone_repair.h"
#include "render_client/link/rate_meter.h"
#include "render_client/link/server_connection.h"

namespace osteomill {

class BoneLink::Impl {
  public:
    Impl(std::string host, std::uint16_t port, const std::optional<std::filesystem::path>& record,
         const std::optional<TlsFiles>& tls)
        : connection_(std::move(host), port, record, tls) {}

    LinkUpdate poll() {
        LinkUpdate update;
        std::size_t taken = 0;
        for (; taken < LinkQueue::capacity; ++taken) {
            std::optional<LinkEvent> event = connection_.events().pop();
            if (!event) break;
            std::visit([&](auto& what) { take(std::move(what), update); }, *event);
        }
        if (taken > 0) connection_.resume();
        complete(update);
        return update;
    }

    const Bone* bone() const { return follower_ ? &follower_->bone() : nullptr; }
    const SessionInfo* session() const { return session_ ? &*session_ : nullptr; }

    void send(const OperatorIntent& intent) {
        if (!session_ || !session_->accepts_operator) return;
        const auto checked = intent_from(to_message(intent), session_->burrs.size());
        if (const auto* good = std::get_if<OperatorIntent>(&checked)) connection_.send(*good);
    }

    std::string finish_recording() {
        connection_.finish_recording();
        return connection_.recording_error();
    }

  private:
    void take(SessionBegan began, LinkUpdate&) {
        session_ = std::move(began.info);
        session_number_ = began.number;
        delay_meter_ = {};
        delay_.reset();
        repair_.reset();
    }

    void take(BoneArrived arrived, LinkUpdate& update) {
        follower_.emplace(std::move(arrived), session_->burrs.size());
        update.bone_replaced = true;
        update.dirty_bricks.clear();
    }

    void take(StatusChanged changed, LinkUpdate&) {
        status_ = changed.status;
        line_ = std::move(changed.line);
    }

    void take(StateArrived arrived, LinkUpdate& update) {
        auto error = apply(arrived, update);
        if (!error) return;
        repair_.reset();
        status_ = LinkStatus::lost;
        line_ = error->line + "; asking for the bone afresh";
        connection_.events().disown();
        connection_.reconnect();
    }

    std::optional<WireError> apply(const StateArrived& arrived, LinkUpdate& update) {
        auto outcome = follower_->apply(arrived.frame, update.dirty_bricks);
        if (update.bone_replaced) update.dirty_bricks.clear();
        if (auto* error = std::get_if<WireError>(&outcome)) {
            ++rejected_;
            return std::move(*error);
        }
        ++frames_;
        auto& applied = std::get<BoneFollower::Applied>(outcome);
        if (applied.check == CopyCheck::equal) ++verified_;
        update.tool = std::move(applied.tool);
        if (arrived.follows_gap) ++rejected_;
        if (repair_) return follow(repair_->take(arrived, applied.check, *follower_));

        const bool differs = applied.check == CopyCheck::differs || applied.has_regained_bone;
        if (differs) ++mismatches_;
        if (!differs && !arrived.follows_gap) return std::nullopt;
        if (session_->protocol_minor < first_minor_that_compares)
            return WireError{"the bone differs from the server's"};
        repair_.emplace();
        return follow(repair_->begin(*follower_));
    }

    std::optional<WireError> follow(BoneRepair::Progress progress) {
        if (auto* error = std::get_if<WireError>(&progress)) return std::move(*error);
        if (const auto* goes_on = std::get_if<BoneRepair::GoesOn>(&progress)) {
            if (goes_on->ask) connection_.send(*goes_on->ask, session_number_);
        } else {
            ++repairs_;
            bricks_repaired_ += std::get<BoneRepair::Done>(progress).bricks;
            repair_.reset();
        }
        return std::nullopt;
    }

    void complete(LinkUpdate& update) {
        const LinkCounters& counters = connection_.counters();
        std::ranges::sort(update.dirty_bricks);
        const auto repeated = std::ranges::unique(update.dirty_bricks);
        update.dirty_bricks.erase(repeated.begin(), repeated.end());
        if (update.tool && update.tool->taken_unix_ns != 0)
            delay_ = delay_meter_.update(update.tool->taken_unix_ns, std::chrono::system_clock::now());
        update.delay = delay_;
        update.status = status_;
        update.status_line =
            repair_ ? "the bone differs from the server's; asking for the bricks that differ" : line_;
        update.recording_error = connection_.recording_error();
        if (status_ == LinkStatus::receiving_snapshot) {
            update.snapshot_bricks = counters.snapshot_bricks;
            update.snapshot_bricks_total = counters.snapshot_bricks_total;
        }
        update.frames = frames_;
        update.checksums_verified = verified_;
        update.checksum_mismatches = mismatches_;
        update.rejected_frames = rejected_ + counters.rejected_frames;
        update.connections = counters.connections;
        update.repairs = repairs_;
        update.bricks_repaired = bricks_repaired_;
        const auto now = std::chrono::steady_clock::now();
        update.frames_per_s = frame_rate_.update(frames_, now);
        update.bytes_per_s = byte_rate_.update(counters.bytes, now);
    }

    ServerConnection connection_;
    LinkStatus status_ = LinkStatus::connecting;
    std::string line_;
    std::optional<SessionInfo> session_;
    std::uint64_t session_number_ = 0;
    std::optional<BoneFollower> follower_;
    std::optional<BoneRepair> repair_;
    std::uint64_t frames_ = 0;
    std::uint64_t verified_ = 0;
    std::uint64_t mismatches_ = 0;
    std::uint64_t rejected_ = 0;
    std::uint64_t repairs_ = 0;
    std::uint64_t bricks_repaired_ = 0;
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
    return impl_->bone();
}
const SessionInfo* BoneLink::session() const {
    return impl_->session();
}
void BoneLink::send_operator(const OperatorIntent& intent) {
    impl_->send(intent);
}
std::string BoneLink::finish_recording() {
    return impl_->finish_recording();
}

}  // namespace osteomill
