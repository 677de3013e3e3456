// A client without a network: takes a server's frames in order and keeps the bone that they describe.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "common/wire/brick_edit.h"
#include "common/wire/frame.h"
#include "common/wire/packed_changes.h"
#include "common/wire/snapshot.h"
#include "osteomill/v1/session.pb.h"

namespace osteomill::testing {

class Replica {
  public:
    /// Takes the bytes of one frame, and expects it to make sense.
    void take(const std::string& bytes) {
        decoder_.append({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
        const auto message = decoder_.next();
        ASSERT_TRUE(message) << decoder_.error();
        v1::ServerFrame frame;
        ASSERT_TRUE(frame.ParseFromArray(message->data(), static_cast<int>(message->size())));
        ASSERT_EQ(frame.sequence(), ++sequence_);
        take(frame);
    }

    const std::optional<Bone>& bone() const { return bone_; }
    std::size_t states() const { return states_; }
    /// The sequence of the last frame.
    std::uint64_t sequence() const { return sequence_; }
    std::size_t edits_of_last_state() const { return edits_of_last_state_; }
    std::size_t checksums() const { return checksums_; }
    /// Edits that gave bone back.
    std::size_t restored_bricks() const { return restored_bricks_; }
    /// Session events that it was told.
    std::size_t events() const { return events_; }
    bool has_goodbye() const { return has_goodbye_; }
    /// Whether any state told its edits as packed changes.
    bool has_packed_changes() const { return has_packed_changes_; }

  private:
    void take(const v1::ServerFrame& frame) {
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
            ++states_;
            std::vector<v1::BrickEdit> edits(frame.state().edits().begin(), frame.state().edits().end());
            if (frame.state().has_changes()) {
                has_packed_changes_ = true;
                auto unpacked = unpack(frame.state().changes(), bone_->content().size_bricks);
                ASSERT_TRUE(std::holds_alternative<std::vector<v1::BrickEdit>>(unpacked))
                    << std::get<WireError>(unpacked).line;
                edits = std::get<std::vector<v1::BrickEdit>>(std::move(unpacked));
            }
            edits_of_last_state_ = edits.size();
            for (const v1::BrickEdit& edit : edits) {
                const auto error = apply_brick_edit(edit, *bone_);
                ASSERT_FALSE(error) << error->line;
            }
            std::vector<v1::BrickEdit> restored(frame.state().restored().begin(),
                                                frame.state().restored().end());
            if (frame.state().has_restored_changes()) {
                auto unpacked = unpack(frame.state().restored_changes(), bone_->content().size_bricks);
                ASSERT_TRUE(std::holds_alternative<std::vector<v1::BrickEdit>>(unpacked));
                restored = std::get<std::vector<v1::BrickEdit>>(std::move(unpacked));
            }
            restored_bricks_ += restored.size();
            for (const v1::BrickEdit& edit : restored)
                ASSERT_TRUE(std::holds_alternative<EditEffect>(correct_with_brick_edit(edit, *bone_)));
            events_ += static_cast<std::size_t>(frame.state().events_size());
            if (frame.state().bone_checksum() != 0) {
                ++checksums_;
                EXPECT_EQ(checksum(*bone_), frame.state().bone_checksum());
            }
        } else if (frame.has_goodbye()) {
            has_goodbye_ = true;
        }
    }

    FrameDecoder decoder_;
    std::uint64_t sequence_ = 0;
    std::optional<SnapshotAssembler> assembler_;
    std::optional<Bone> bone_;
    std::size_t states_ = 0;
    std::size_t edits_of_last_state_ = 0;
    std::size_t checksums_ = 0;
    std::size_t restored_bricks_ = 0;
    std::size_t events_ = 0;
    bool has_goodbye_ = false;
    bool has_packed_changes_ = false;
};

}  // namespace osteomill::testing
