// A recording written frame by frame, as a server writes one: for sessions whose metrics are known.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/wire/scene_messages.h"
#include "common/wire/structure_messages.h"
#include "haptic_server/streaming/session_recorder.h"
#include "tests/support/labelled_cube.h"

namespace osteomill::testing {

class WrittenSession {
  public:
    WrittenSession(const std::filesystem::path& file, const SessionInfo& session, const Bone& bone,
                   const std::vector<Structure>& structures = {}, bool with_ticks = false)
        : mirror_(bone),
          structures_(structure_pieces(structures)),
          recorder_(std::in_place,
                    RecordTo{.file = file,
                             .began = Stamp{std::chrono::seconds(1'700'000'000)},
                             .ticks = with_ticks ? &ticks_ : nullptr},
                    to_message(session), mirror_, structures_) {}

    /// Takes all of every voxel whose centre `is_in`, before the next frame. Returns how many there were.
    std::size_t cut(const std::function<bool(const glm::dvec3&)>& is_in) {
        return set(is_in, 0, ChangeKind::milled);
    }
    /// Gives all of them back.
    std::size_t restore(const std::function<bool(const glm::dvec3&)>& is_in) {
        return set(is_in, 255, ChangeKind::restored);
    }
    /// Takes them again.
    std::size_t redo(const std::function<bool(const glm::dvec3&)>& is_in) {
        return set(is_in, 0, ChangeKind::restored);
    }
    /// Before the frame that is to hold it.
    void tick(const TickSample& tick) { ticks_.push(tick); }
    /// From now on, until it changes.
    void look(const Viewpoint& view) { view_ = view; }
    void event(const ControlEvent& event) { events_.push_back(event); }
    void frame(const ToolState& tool, const SessionStatus& status = {}) {
        recorder_->note(mirror_.take_changes());
        last_ = {.tool = tool, .status = status, .view = view_};
        SessionState state = last_;
        state.events = std::exchange(events_, {});
        recorder_->record(std::move(state), true);
    }
    /// With the last frame once more.
    void finish() {
        recorder_->finish(last_, "the end");
        EXPECT_EQ(recorder_->report().error, "");
        recorder_.reset();
    }

  private:
    std::size_t set(const std::function<bool(const glm::dvec3&)>& is_in, std::uint8_t fraction,
                    ChangeKind kind) {
        const Bone& bone = mirror_.bone();
        const BoneContent& content = bone.content();
        std::size_t count = 0;
        for (const BrickIndex brick : content.brick_of_slot) {
            BrickChange change{.brick = brick, .voxels = {}, .kind = kind};
            ByteBrick fractions{};
            fractions.fill(fraction);
            const BrickFractions now = bone.fractions(bone.slot(brick));
            const glm::ivec3 first = brick_edge_voxels * brick_position(content.size_bricks, brick);
            for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
                if (now[offset] != fraction &&
                    is_in(centre_of_voxel_mm(bone.grid(), first + voxel_in_brick(offset))))
                    change.voxels.set(offset);
            count += change.voxels.count();
            if (change.voxels.any()) {
                EXPECT_TRUE(mirror_.apply(change, fractions));
            }
        }
        return count;
    }

    BoneReplica mirror_;
    std::vector<v2::StructureBricks> structures_;
    SampleQueue<TickSample> ticks_;
    std::optional<SessionRecorder> recorder_;
    std::vector<ControlEvent> events_;
    std::optional<Viewpoint> view_;
    SessionState last_;
};

}  // namespace osteomill::testing
