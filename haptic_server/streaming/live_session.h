// The session of the haptic and milling loops, for a streaming server to show: takes their changes and the
// tool once a frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/scene/scene.h"
#include "common/session/structure_distance.h"
#include "common/session/structure_watch.h"
#include "common/session/tool_state.h"
#include "common/wire/session_info.h"
#include "haptic_server/streaming/control_runner.h"
#include "haptic_server/streaming/control_script.h"
#include "haptic_server/streaming/stream_source.h"
#include "simulation/exchange/change_queue.h"
#include "simulation/exchange/triple_buffer.h"

namespace osteomill {

/// Log lines about protected structures: a line when the burr comes within the structure's warning distance,
/// and a line when it begins to touch it.
///
/// A burr that hovers at the limit is logged once: before the next warning it must move away to one and a
/// half times the distance. Bounded: at most most_lines, however long the session.
class StructureLog {
  public:
    static constexpr std::size_t most_lines = 200;

    /// `tissues`: those that distances name by their index.
    explicit StructureLog(std::vector<Tissue> tissues)
        : tissues_(std::move(tissues)), is_warned_of_(tissues_.size()), touches_logged_(tissues_.size()) {}

    /// The lines due now, mostly none.
    std::vector<std::string> lines(std::span<const StructureDistance> distances, double time_s);

  private:
    void say(std::vector<std::string>& lines, std::string line);

    std::vector<Tissue> tissues_;
    std::vector<bool> is_warned_of_;             // by tissue
    std::vector<std::uint32_t> touches_logged_;  // by tissue
    std::size_t said_ = 0;
};

/// The session info about a scene that clients are sent.
SessionInfo session_info(const Scene& scene, bool accepts_operator, double force_limit_n,
                         std::string program_version);

/// The only reader of `tool` and only consumer of `changes`; both outlive it. Never waits for the loops.
class LiveSession final : public StreamSource {
  public:
    /// `controls`: outlives it; null for a session without controls. `script`: controls that are due at given
    /// times.
    LiveSession(TripleBuffer<ToolState>& tool, ChangeQueue& changes, ControlRunner* controls = nullptr,
                ControlScript script = {})
        : tool_(tool), changes_(changes), controls_(controls), script_(std::move(script)) {}
    /// Makes the CT for display, on a thread of its own, at the first request.
    void offer_ct(std::function<CtVolume()> make) { make_ct_ = std::move(make); }
    /// The protected structures that are looked at from now on. Approaches and touches are logged.
    void watch(StructureWatch structures, std::vector<Tissue> tissues);
    /// From now on the cut of the edges is sent with the tool. The one reader of `cuts`, which outlives it.
    void listen_to(TripleBuffer<std::optional<CutState>>& cuts) { cuts_ = &cuts; }
    /// Outcomes for the structures; call after the end of the streaming server.
    const StructureWatch& structures() const { return structures_; }
    SessionState update(BoneReplica& mirror, std::size_t viewers) override;
    void control(const SessionControl& control) override;
    std::shared_ptr<const CtVolume> ct() override;

  private:
    void note_for_structures(const BrickChange& change, BrickFractions after, const Bone& bone);

    TripleBuffer<ToolState>& tool_;
    TripleBuffer<std::optional<CutState>>* cuts_ = nullptr;
    ChangeQueue& changes_;
    ControlRunner* controls_;
    ControlScript script_;
    StructureWatch structures_;
    std::optional<StructureLog> structure_log_;
    std::function<CtVolume()> make_ct_;
    std::future<CtVolume> ct_under_way_;
    std::shared_ptr<const CtVolume> ct_;
};

}  // namespace osteomill
