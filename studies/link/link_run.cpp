#include "studies/link/link_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "common/statistics/percentile.h"
#include "common/wire/frame.h"
#include "common/wire/scene_messages.h"
#include "common/wire/sealed_frame.h"
#include "common/wire/session_receiver.h"
#include "haptic_server/streaming/outgoing_frames.h"
#include "studies/swept_changes.h"

namespace osteomill::study {

namespace {

/// Longer than any link needs that keeps up with milling.
constexpr double longest_wait_for_rest_s = 60.0;

/// Voxels in which two bones differ, kept up brick by brick.
class Difference {
  public:
    void look_again(BrickIndex brick, const Bone& one, const Bone& other) {
        const auto a = one.fractions(one.slot(brick)), b = other.fractions(other.slot(brick));
        std::size_t differing = 0;
        for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel) differing += a[voxel] != b[voxel];
        std::size_t& before = by_brick_[brick];
        count_ += differing - before;
        before = differing;
    }
    std::size_t count() const { return count_; }

  private:
    std::map<BrickIndex, std::size_t> by_brick_{};
    std::size_t count_ = 0;
};

/// The far end: takes frames as they arrive, and keeps its copy of the bone.
class Client {
  public:
    Client(LinkContent content, double radius_mm) : content_(content), radius_mm_(radius_mm) {}

    /// The bricks that it changed.
    std::vector<BrickIndex> take(const std::string& frame) {
        decoder_.append({reinterpret_cast<const std::uint8_t*>(frame.data()), frame.size()});
        std::vector<BrickIndex> changed;
        while (const auto message = decoder_.next()) {
            auto opened = open_frame(*message);
            auto event = receiver_.take(std::get<v2::ServerFrame>(std::move(opened)));
            take(std::get<SessionEvent>(std::move(event)), changed);
        }
        return changed;
    }
    const Bone& bone() const { return own_ ? *own_ : replica_->bone(); }
    /// Time of the state that it shows; nothing before its first.
    std::optional<double> shown_s() const { return shown_ ? std::optional(shown_->time_s) : std::nullopt; }

  private:
    void take(SessionEvent event, std::vector<BrickIndex>& changed) {
        if (auto* const arrived = std::get_if<BoneArrived>(&event)) {
            if (content_ == LinkContent::poses) own_ = arrived->bone;
            replica_.emplace(std::move(arrived->bone), std::move(arrived->checksum));
        }
        const auto* const state = std::get_if<StateArrived>(&event);
        if (state == nullptr) return;
        if (std::holds_alternative<WireError>(follow(*state, *replica_)))
            throw std::logic_error("a client was sent what does not fit its bone");
        for (const ChangedBrick& brick : state->changes) changed.push_back(brick.change.brick);
        const ToolState& tool = state->state.tool;
        if (content_ == LinkContent::poses && shown_) carve_itself(tool, changed);
        shown_ = tool;
    }
    void carve_itself(const ToolState& tool, std::vector<BrickIndex>& changed) {
        for (const BrickChange& change :
             swept_changes(*own_, shown_->burr_position_mm, tool.burr_position_mm, radius_mm_))
            changed.push_back(change.brick);
    }

    LinkContent content_;
    double radius_mm_;
    FrameDecoder decoder_;
    SessionReceiver receiver_;
    std::optional<BoneReplica> replica_;
    std::optional<Bone> own_;  // that it carves for itself
    std::optional<ToolState> shown_;
};

/// The near end: the bone that is milled, and the mirror of it that clients are shown.
class Server {
  public:
    Server(const Bone& bone, const Burr& burr, const LinkChoice& choice)
        : bone_(bone),
          mirror_(bone),
          outgoing_(to_message(SessionInfo{.scene_name = "link", .burrs = {burr}}), mirror_, packers_),
          content_(choice.content),
          radius_mm_(0.5 * burr.diameter_mm) {}

    /// The bricks that it changed.
    std::vector<BrickIndex> mill(const glm::dvec3& from_mm, const glm::dvec3& to_mm) {
        std::vector<BrickIndex> changed;
        for (const BrickChange& change : swept_changes(bone_, from_mm, to_mm, radius_mm_)) {
            waiting_.add(change);
            changed.push_back(change.brick);
        }
        return changed;
    }
    void show(const ToolState& tool, bool with_checksum) {
        for (const BrickChange& change : waiting_.take())
            if (!mirror_.apply(change, bone_.fractions(bone_.slot(change.brick))))
                throw std::logic_error("what was milled does not fit the bone that is shown");
        std::vector<BrickChange> changes = mirror_.take_changes();
        if (content_ == LinkContent::bricks)
            for (BrickChange& change : changes) change.voxels.set_all();
        if (content_ != LinkContent::poses) outgoing_.note(changes);
        outgoing_.request_state({.tool = tool}, with_checksum && content_ != LinkContent::poses);
    }
    OutgoingFrames& outgoing() { return outgoing_; }
    const Bone& bone() const { return bone_; }

  private:
    Bone bone_;
    GatheredChanges waiting_;  // for the next frame
    BoneReplica mirror_;
    FramePackers packers_;
    OutgoingFrames outgoing_;
    LinkContent content_;
    double radius_mm_;
};

/// The cable: a frame after the other, each as long on the way as the link takes for it.
class Cable {
  public:
    explicit Cable(const LinkChoice& choice) : choice_(choice) {}

    bool is_free(double now_s) const { return now_s >= free_at_s_; }
    void send(std::string frame, double now_s) {
        const double took_s = static_cast<double>(frame.size()) / choice_.bytes_per_s;
        pace_.wrote(frame.size(), took_s);
        free_at_s_ = now_s + took_s;
        under_way_.push_back({free_at_s_ + choice_.latency_s, std::move(frame)});
    }
    std::optional<std::string> arrived(double now_s) {
        if (under_way_.empty() || now_s < under_way_.front().first) return std::nullopt;
        std::string frame = std::move(under_way_.front().second);
        under_way_.pop_front();
        return frame;
    }
    bool is_empty() const { return under_way_.empty(); }
    std::size_t most_bytes() const { return pace_.most_bytes(); }

  private:
    LinkChoice choice_;
    FramePace pace_;
    double free_at_s_ = 0.0;
    std::deque<std::pair<double, std::string>> under_way_{};
};

class LinkRun {
  public:
    LinkRun(const Bone& bone, const Burr& burr, const glm::dvec3& axis, double tick_s,
            const LinkChoice& choice)
        : server_(bone, burr, choice),
          client_(choice.content, 0.5 * burr.diameter_mm),
          cable_(choice),
          tick_s_(tick_s),
          frame_rate_hz_(choice.frame_rate_hz) {
        tool_.spindle_axis = axis;
        tool_.spindle_on = true;
        while (const auto frame = server_.outgoing().next()) client_.take(*frame);
    }

    void tick(const glm::dvec3& position_mm) {
        if (ticks_ > 0) look_at(server_.mill(tool_.burr_position_mm, position_mm));
        tool_.burr_position_mm = position_mm;
        tool_.time_s = tick_s_ * static_cast<double>(ticks_);
        const double now_s = tool_.time_s;
        if (now_s * frame_rate_hz_ >= static_cast<double>(frames_) - 1e-9) show(now_s);
        while (cable_.is_free(now_s) && send(now_s)) {
        }
        while (const auto frame = cable_.arrived(now_s)) look_at(client_.take(*frame));
        if (client_.shown_s()) {
            delays_ms_.push_back(1e3 * (now_s - *client_.shown_s()));
            differing_.push_back(static_cast<double>(difference_.count()));
        }
        ++ticks_;
    }

    LinkOutcome outcome() {
        LinkOutcome outcome{.delay_mean_ms = mean(delays_ms_),
                            .delay_p99_ms = percentile(delays_ms_, 0.99),
                            .differing_voxels_mean = mean(differing_),
                            .frame_us = percentile(frame_us_, 0.5)};
        for (const auto& [second, bytes] : bytes_in_second_) {
            outcome.bytes_per_s += bytes / tool_.time_s;
            outcome.most_bytes_in_a_second = std::max(outcome.most_bytes_in_a_second, bytes);
        }
        if (!differing_.empty())
            outcome.differing_voxels_most = static_cast<std::size_t>(std::ranges::max(differing_));
        const double end_s = tool_.time_s;
        while (tool_.time_s < end_s + 1.0 || !server_.outgoing().has_sent_all() || !cable_.is_empty()) {
            if (tool_.time_s > end_s + longest_wait_for_rest_s) break;
            tick(tool_.burr_position_mm);
        }
        outcome.differing_voxels_left = difference_.count();
        return outcome;
    }

  private:
    static double mean(const std::vector<double>& values) {
        double sum = 0.0;
        for (const double value : values) sum += value;
        return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
    }
    void show(double now_s) {
        const bool with_checksum = now_s >= static_cast<double>(checksums_);  // every second
        if (with_checksum) ++checksums_;
        while (static_cast<double>(frames_) <= now_s * frame_rate_hz_ + 1e-9) ++frames_;
        server_.show(tool_, with_checksum);
    }
    bool send(double now_s) {
        const auto began = std::chrono::steady_clock::now();
        auto frame = server_.outgoing().next(cable_.most_bytes());
        if (!frame) return false;
        frame_us_.push_back(
            std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - began).count());
        bytes_in_second_[static_cast<int>(now_s)] += static_cast<double>(frame->size());
        cable_.send(std::move(*frame), now_s);
        return true;
    }
    void look_at(const std::vector<BrickIndex>& bricks) {
        for (const BrickIndex brick : bricks) difference_.look_again(brick, server_.bone(), client_.bone());
    }

    Server server_;
    Client client_;
    Cable cable_;
    Difference difference_;
    ToolState tool_;
    double tick_s_;
    double frame_rate_hz_;
    std::uint64_t ticks_ = 0;
    std::uint64_t frames_ = 0;
    std::uint64_t checksums_ = 0;
    std::vector<double> delays_ms_{};
    std::vector<double> differing_{};
    std::vector<double> frame_us_{};
    std::map<int, double> bytes_in_second_{};
};

}  // namespace

LinkContent link_content_named(const std::string& name) {
    if (name == "changes") return LinkContent::changes;
    if (name == "bricks") return LinkContent::bricks;
    if (name == "poses") return LinkContent::poses;
    throw std::invalid_argument("content: '" + name + "' is not one of changes, bricks, poses");
}

LinkOutcome run_link(const Bone& bone, const Burr& burr, const glm::dvec3& axis, double tick_s,
                     std::span<const glm::dvec3> positions_mm, const LinkChoice& choice) {
    if (!burr.is_ball()) throw std::invalid_argument("a link is tried with a ball, not with another head");
    if (!(tick_s > 0.0) || !(choice.frame_rate_hz > 0.0) || !(choice.bytes_per_s > 0.0) ||
        !(choice.latency_s >= 0.0) || positions_mm.size() < 2)
        throw std::invalid_argument(
            "a link needs a tick, frames a second and bytes a second above 0, a latency of 0 or more and a "
            "path of two positions or more");
    LinkRun run(bone, burr, axis, tick_s, choice);
    for (const glm::dvec3& position_mm : positions_mm) run.tick(position_mm);
    return run.outcome();
}

}  // namespace osteomill::study
