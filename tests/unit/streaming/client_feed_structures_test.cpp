// What a client is sent of protected structures, and when.
#include <gtest/gtest.h>

#include <optional>

#include "common/wire/frame.h"
#include "common/wire/scene_messages.h"
#include "common/wire/sealed_frame.h"
#include "common/wire/session_receiver.h"
#include "haptic_server/streaming/client_message.h"
#include "tests/support/ball_structure.h"
#include "tests/support/speckled_bone.h"

namespace osteomill {
namespace {

class ClientFeedOfStructures : public ::testing::Test {
  protected:
    ClientFeedOfStructures() {
        std::mt19937 random(2);
        mirror_.emplace(testing::make_speckled_bone(random, {.grid = {.size_voxels = {128, 128, 64}}}));
    }
    std::optional<BoneReplica> mirror_;
    SnapshotPacker packer_;
    std::optional<ClientFeed> feed_;
};

TEST_F(ClientFeedOfStructures, TellsWhereProtectedStructuresAreBeforeTheFirstState) {
    const std::vector<Structure> structures{
        {0, testing::ball_mask(mirror_->bone().grid(), {3.0, 3.0, 3.0}, 2.0)}};
    const std::vector<v1::StructureBricks> pieces = structure_pieces(structures);
    const SessionInfo session{.burrs = {Burr{}}, .tissues = {{.label = 1, .is_protected = true}}};
    feed_.emplace(to_message(session), *mirror_, packer_);
    feed_->give_structures(pieces);
    const StructureDistance near{.tissue = 0, .distance_mm = 0.7};
    feed_->note(std::span(&near, 1));
    feed_->request_state({}, false);
    SessionReceiver receiver;
    FrameDecoder decoder;
    std::optional<Structure> arrived;
    std::optional<StateArrived> state;
    while (const auto bytes = feed_->next()) {
        decoder.append({reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()});
        auto opened = open_frame(*decoder.next(), Seal::required);
        auto event = receiver.take(std::get<v1::ServerFrame>(std::move(opened)));
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
    EXPECT_EQ(std::get<0>(structure_distances_from(state->frame.distances(), 1)), std::vector{near});
    // What is as it was is no news; a distance that changes is.
    feed_->request_state({.time_s = 0.03}, false);
    EXPECT_FALSE(feed_->next());
    const StructureDistance nearer{.tissue = 0, .distance_mm = 0.6};
    feed_->note(std::span(&nearer, 1));
    feed_->request_state({.time_s = 0.06}, false);
    EXPECT_TRUE(feed_->next());
}

TEST_F(ClientFeedOfStructures, SparesAnOlderClientWhatItWouldNotUnderstand) {
    const std::vector<v1::StructureBricks> pieces = structure_pieces(
        std::vector<Structure>{{0, testing::ball_mask(mirror_->bone().grid(), {3.0, 3.0, 3.0}, 2.0)}});
    for (const std::uint32_t minor : {9u, 10u, 11u}) {
        ClientFeed feed({}, *mirror_, packer_);
        AnsweredStates answers;
        ChangePacker change_packer;
        v1::ClientFrame hello;
        hello.mutable_hello()->set_protocol_minor(minor);
        (void)take_client_message(
            hello, {.feed = feed, .answers = answers, .packer = change_packer, .structures = &pieces}, {});
        std::size_t structures = 0;
        FrameDecoder decoder;
        while (const auto bytes = feed.next()) {
            decoder.append({reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()});
            const auto opened = open_frame(*decoder.next(), Seal::required);
            structures += std::get<v1::ServerFrame>(opened).has_structure_bricks() ? 1 : 0;
        }
        EXPECT_EQ(structures, minor < 10 ? 0u : pieces.size()) << minor;
    }
}

}  // namespace
}  // namespace osteomill
