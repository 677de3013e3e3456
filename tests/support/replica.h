// A client without a network: takes a server's frames in order and keeps the bone that they describe.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/wire/bone_replica.h"
#include "common/wire/frame.h"
#include "common/wire/packed_changes.h"
#include "common/wire/snapshot.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill::testing {

class Replica {
  public:
    /// Takes the bytes of one frame, and expects it to make sense.
    void take(const std::string& bytes) {
        decoder_.append({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
        const auto message = decoder_.next();
        ASSERT_TRUE(message) << decoder_.error();
        v2::ServerFrame frame;
        ASSERT_TRUE(frame.ParseFromArray(message->data(), static_cast<int>(message->size())));
        ASSERT_EQ(frame.sequence(), ++sequence_);
        take(frame);
    }

    const std::optional<Bone>& bone() const { return bone_; }
    std::size_t states() const { return states_; }
    /// The sequence of the last frame.
    std::uint64_t sequence() const { return sequence_; }
    std::size_t bricks_of_last_state() const { return bricks_of_last_state_; }
    std::size_t checksums() const { return checksums_; }
    /// Changes that gave bone back.
    std::size_t restored_bricks() const { return restored_bricks_; }
    /// Session events that it received.
    std::size_t events() const { return events_; }
    bool has_goodbye() const { return has_goodbye_; }

  private:
    void take(const v2::ServerFrame& frame) {
        ASSERT_FALSE(has_goodbye_);
        if (frame.has_snapshot_begin()) {
            assembler_.emplace(std::get<SnapshotAssembler>(SnapshotAssembler::begin(frame.snapshot_begin())));
        } else if (frame.has_snapshot_bricks()) {
            const auto error = assembler_->add(frame.snapshot_bricks());
            ASSERT_FALSE(error) << error->line;
        } else if (frame.has_snapshot_end()) {
            auto result = std::move(*assembler_).finish(frame.snapshot_end());
            ASSERT_TRUE(std::holds_alternative<Bone>(result)) << std::get<WireError>(result).line;
            bone_ = std::get<Bone>(std::move(result));
        } else if (frame.has_state()) {
            ASSERT_TRUE(bone_);
            take(frame.state());
        } else if (frame.has_goodbye()) {
            has_goodbye_ = true;
        }
    }
    void take(const v2::StateFrame& state) {
        ++states_;
        std::vector<ChangedBrick> changes;
        const glm::ivec3 size_bricks = bone_->content().size_bricks;
        if (state.has_changes()) {
            const auto error = unpack(state.changes(), ChangeKind::milled, size_bricks, changes);
            ASSERT_FALSE(error) << error->line;
        }
        bricks_of_last_state_ = changes.size();
        if (state.has_restored()) {
            const auto error = unpack(state.restored(), ChangeKind::restored, size_bricks, changes);
            ASSERT_FALSE(error) << error->line;
        }
        restored_bricks_ += changes.size() - bricks_of_last_state_;
        for (const auto& [change, fractions] : changes) ASSERT_TRUE(apply(change, fractions, *bone_));
        events_ += static_cast<std::size_t>(state.events_size());
        if (state.bone_checksum() != 0) {
            ++checksums_;
            EXPECT_EQ(checksum(*bone_), state.bone_checksum());
        }
    }

    FrameDecoder decoder_;
    std::uint64_t sequence_ = 0;
    std::optional<SnapshotAssembler> assembler_;
    std::optional<Bone> bone_;
    std::size_t states_ = 0;
    std::size_t bricks_of_last_state_ = 0;
    std::size_t checksums_ = 0;
    std::size_t restored_bricks_ = 0;
    std::size_t events_ = 0;
    bool has_goodbye_ = false;
};

}  // namespace osteomill::testing
