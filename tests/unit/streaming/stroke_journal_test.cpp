#include "haptic_server/streaming/stroke_journal.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/random_carving.h"
#include "tests/support/speckled_bone.h"

namespace osteomill {
namespace {

/// Mills a bone as the milling loop does, and tells the journal of it in time.
class StrokeJournalTest : public ::testing::Test, public ChangeSink {
  protected:
    StrokeJournalTest() : mirror_(testing::make_speckled_bone(random_)), milled_(mirror_) {}

    void push(const BrickChange& change, BrickFractions fractions) noexcept override {
        journal_.note(change, mirror_);
        EXPECT_TRUE(apply(change, fractions, mirror_));
    }
    void stroke(int runs) {
        milled_ = mirror_;
        for (int i = 0; i < runs; ++i) testing::carve_somewhere(milled_, random_, *this);
        journal_.end_stroke();
    }
    void undo() {
        StrokeJournal::Restoration restoration;
        journal_.undo(mirror_, restoration);
        restore(restoration);
    }
    void redo() {
        StrokeJournal::Restoration restoration;
        journal_.redo(mirror_, restoration);
        restore(restoration);
    }
    void restore(const StrokeJournal::Restoration& restoration) {
        for (const auto& [index, brick] : restoration) {
            EXPECT_EQ(brick.change.brick, index);
            EXPECT_EQ(brick.change.kind, ChangeKind::restored);
            journal_.note(brick.change, mirror_);  // as it comes back from the milling loop
            EXPECT_TRUE(apply(brick.change, brick.fractions, mirror_));
        }
    }

    std::mt19937 random_{11};
    Bone mirror_;
    Bone milled_;
    StrokeJournal journal_;
};

TEST_F(StrokeJournalTest, UndoesAndRedoesAnyNumberOfStrokesToTheBit) {
    std::vector<std::uint64_t> checksums{checksum(mirror_)};
    for (int i = 0; i < 30; ++i) {
        stroke(1 + i * 7);
        checksums.push_back(checksum(mirror_));
    }
    ASSERT_EQ(journal_.undo_steps(), 30U);
    // A walk to and fro over all strokes.
    std::size_t at = 30;
    for (int i = 0; i < 300; ++i) {
        const bool undoes = at == 30 || (at > 0 && random_() % 2 == 0);
        if (undoes)
            undo();
        else
            redo();
        at += undoes ? -1 : 1;
        ASSERT_EQ(checksum(mirror_), checksums[at]);
        ASSERT_EQ(journal_.undo_steps(), at);
        ASSERT_EQ(journal_.redo_steps(), 30 - at);
    }
}

TEST_F(StrokeJournalTest, RestoresAnyNumberOfStrokesInOneChange) {
    std::vector<std::uint64_t> checksums{checksum(mirror_)};
    for (int i = 0; i < 30; ++i) {
        stroke(1 + i * 7);
        checksums.push_back(checksum(mirror_));
    }
    // Walks of any length to and fro, each one change.
    std::size_t at = 30;
    for (int i = 0; i < 100; ++i) {
        StrokeJournal::Restoration walk;
        for (auto steps = random_() % 50; steps > 0; --steps) {
            const bool undoes = at == 30 || (at > 0 && random_() % 2 == 0);
            if (undoes)
                journal_.undo(mirror_, walk);
            else
                journal_.redo(mirror_, walk);
            at += undoes ? -1 : 1;
        }
        restore(walk);
        ASSERT_EQ(checksum(mirror_), checksums[at]);
        ASSERT_EQ(journal_.undo_steps(), at);
        ASSERT_EQ(journal_.redo_steps(), 30 - at);
    }
}

TEST_F(StrokeJournalTest, ForgetsWhatWasUndoneAsSoonAsTheNextStrokeTakesBone) {
    stroke(20);
    stroke(20);
    undo();
    EXPECT_EQ(journal_.redo_steps(), 1U);
    const std::uint64_t before = checksum(mirror_);
    stroke(20);
    EXPECT_EQ(journal_.redo_steps(), 0U);
    EXPECT_EQ(journal_.undo_steps(), 2U);
    undo();
    EXPECT_EQ(checksum(mirror_), before);
}

TEST_F(StrokeJournalTest, CountsNoStrokeThatTookNothing) {
    journal_.end_stroke();
    journal_.end_stroke();
    EXPECT_EQ(journal_.undo_steps(), 0U);
    StrokeJournal::Restoration restoration;
    EXPECT_THROW(journal_.undo(mirror_, restoration), std::logic_error);
}

TEST_F(StrokeJournalTest, KeepsNoSecondCopyOfTheBone) {
    for (int i = 0; i < 10; ++i) stroke(100);
    // Random fractions do not compress: a byte each, and of the runs of random places a mask.
    EXPECT_LT(journal_.memory_bytes(), memory_bytes(mirror_) / 4);
    EXPECT_GT(journal_.memory_bytes(), 1000U);
}

}  // namespace
}  // namespace osteomill
