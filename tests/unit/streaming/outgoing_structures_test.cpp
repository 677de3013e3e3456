// Messages about protected structures to a client, and their time.
#include <gtest/gtest.h>

#include <optional>

#include "common/wire/frame.h"
#include "common/wire/scene_messages.h"
#include "common/wire/sealed_frame.h"
#include "common/wire/session_receiver.h"
#include "haptic_server/streaming/outgoing_frames.h"
#include "tests/support/ball_structure.h"
#include "tests/support/speckled_bone.h"

namespace osteomill {
namespace {

class OutgoingFramesOfStructures : public ::testing::Test {
  protected:
    OutgoingFramesOfStructures() {
        std::mt19937 random(2);
        mirror_.emplace(testing::make_speckled_bone(random, {.grid = {.size_voxels = {128, 128, 64}}}));
    }
    std::optional<BoneReplica> mirror_;
    FramePackers packers_;
    std::optional<OutgoingFrames> outgoing_;
};

TEST_F(OutgoingFramesOfStructures, TellsWhereProtectedStructuresAreBeforeTheFirstState) {
    const std::vector<Structure> structures{
        {0, testing::ball_mask(mirror_->bone().grid(), {3.0, 3.0, 3.0}, 2.0)}};
    const std::vector<v2::StructureBricks> pieces = structure_pieces(structures);
    const SessionInfo session{.burrs = {Burr{}}, .tissues = {{.label = 1, .is_protected = true}}};
    outgoing_.emplace(to_message(session), *mirror_, packers_, pieces);
    const StructureDistance near{.tissue = 0, .distance_mm = 0.7};
    outgoing_->request_state({.distances = {near}}, false);
    SessionReceiver receiver;
    FrameDecoder decoder;
    std::optional<Structure> arrived;
    std::optional<StateArrived> state;
    while (const auto bytes = outgoing_->next()) {
        decoder.append({reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()});
        auto opened = open_frame(*decoder.next());
        auto event = receiver.take(std::get<v2::ServerFrame>(std::move(opened)));
        ASSERT_TRUE(std::holds_alternative<SessionEvent>(event)) << std::get<WireError>(event).line;
        if (auto* structure = std::get_if<StructureArrived>(&std::get<SessionEvent>(event))) {
            EXPECT_FALSE(state);
            if (structure->structure) arrived = std::move(structure->structure);
        }
        if (auto* told = std::get_if<StateArrived>(&std::get<SessionEvent>(event))) state = std::move(*told);
    }
    ASSERT_TRUE(arrived);
    EXPECT_TRUE(arrived->mask == structures[0].mask);
    ASSERT_TRUE(state);
    EXPECT_EQ(state->state.distances, std::vector{near});
    // An unchanged distance is no news; a changed one is.
    outgoing_->request_state({.tool = {.time_s = 0.03}, .distances = {near}}, false);
    EXPECT_FALSE(outgoing_->next());
    const StructureDistance nearer{.tissue = 0, .distance_mm = 0.6};
    outgoing_->request_state({.tool = {.time_s = 0.06}, .distances = {nearer}}, false);
    EXPECT_TRUE(outgoing_->next());
}

}  // namespace
}  // namespace osteomill
