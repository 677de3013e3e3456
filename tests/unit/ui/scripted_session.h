// A session by script in place of a server: a ball of bone into which a burr sinks, a bit deeper every poll.
#pragma once

#include "render_client/link/session_source.h"
#include "studies/render/made_bone.h"

namespace osteomill {

class ScriptedSession final : public SessionSource {
  public:
    /// Says goodbye after `polls`.
    explicit ScriptedSession(int polls, bool accepts_operator = false)
        : polls_left_(polls),
          bone_(made_bone(
              {.size_voxels = {140, 120, 100}, .origin_mm = {-7.0, -6.0, -5.0}},
              [](const glm::dvec3& p) { return 4.6 - glm::length(p * glm::dvec3(0.75, 0.9, 1.0)); },
              [](const glm::dvec3& p) { return static_cast<std::uint8_t>(p.z > 2.2 ? 2 : 1); })) {
        scene_.scene_name = "scripted";
        scene_.burrs = {{.name = "1 mm", .diameter_mm = 1.0}, {.name = "3 mm", .diameter_mm = 3.0}};
        scene_.tissues = {{1, "dentine", {224, 190, 140}, false}, {2, "enamel", {245, 243, 235}, false}};
        scene_.accepts_operator = accepts_operator;
    }

    LinkUpdate poll() override {
        LinkUpdate update;
        update.status_line = "scripted session";
        update.bone_replaced = first_;
        first_ = false;
        if (polls_left_ <= 0) {
            update.status = LinkStatus::finished;
            update.status_line = "session finished";
            return update;
        }
        --polls_left_;
        update.status = LinkStatus::live;
        update.frames_per_s = 30.0;
        time_s_ += 1.0 / 30.0;
        tool_.time_s = time_s_;
        tool_.burr = 1;
        tool_.spindle_on = true;
        tool_.burr_position_mm = {0.5, -1.5, std::max(6.0 - 0.8 * time_s_, 3.6)};
        tool_.hand_position_mm = tool_.burr_position_mm - glm::dvec3(0.0, 0.0, 0.3);
        tool_.spindle_axis = glm::normalize(glm::dvec3(0.2, -0.2, 1.0));
        tool_.force_n = {0.4 * std::sin(20.0 * time_s_), 0.2, 0.9};
        tool_.removed_mm3 = 0.5 * time_s_;
        update.tool = tool_;
        update.changes = carve_sphere(bone_, tool_.burr_position_mm, 1.5);
        return update;
    }
    const Bone* bone() const override { return &bone_; }
    const SessionInfo* session() const override { return &scene_; }
    void send_operator(const OperatorCommand& command) override { sent = command; }

    std::optional<OperatorCommand> sent;

  private:
    int polls_left_;
    bool first_ = true;
    double time_s_ = 0.0;
    Bone bone_;
    SessionInfo scene_;
    ToolState tool_;
};

}  // namespace osteomill
