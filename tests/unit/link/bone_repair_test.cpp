// A client whose copy of the bone came to differ, over real sockets: it requests the differing parts and no
// more.
#include <gmock/gmock.h>

#include <atomic>
#include <mutex>
#include <set>

#include "render_client/link/bone_link.h"
#include "render_client/link/verified_replica.h"
#include "tests/support/frame_proxy.h"
#include "tests/support/packed.h"
#include "tests/support/served_bone.h"

namespace osteomill {
namespace {

using testing::eventually;
using testing::FrameProxy;
using testing::ServedBone;

/// A proxy that meddles with a session, and counts its frames.
class Meddler {
  public:
    enum class Mode { watch, drop_states, drop_one_brick };

    bool operator()(v2::ServerFrame& frame) {
        const std::scoped_lock lock(mutex_);
        if (frame.has_snapshot_begin()) {
            ++snapshots_;
            const v2::Grid& grid = frame.snapshot_begin().grid();
            size_bricks_ = size_in_bricks(
                {.size_voxels = glm::ivec3(glm::uvec3(grid.size_x(), grid.size_y(), grid.size_z()))});
        }
        if (!frame.has_state()) return true;
        ++states_;
        v2::StateFrame& state = *frame.mutable_state();
        std::vector<ChangedBrick> changes;
        if (state.has_changes()) {
            EXPECT_FALSE(unpack(state.changes(), ChangeKind::milled, size_bricks_, changes));
        }
        for (const auto& [change, fractions] : changes)
            if (mode_ != Mode::watch)
                lost_.insert(change.brick);
            else if (change.voxels.all())
                told_whole_.insert(change.brick);
        if (mode_ == Mode::watch) return true;
        if (mode_ == Mode::drop_states) return false;
        lost_ = lost_.empty() ? lost_ : std::set{*lost_.begin()};
        std::erase_if(changes,
                      [&](const ChangedBrick& changed) { return lost_.contains(changed.change.brick); });
        state.clear_changes();
        if (!changes.empty()) *state.mutable_changes() = testing::packed(changes);
        state.set_bone_checksum(0);  // not to be found out yet
        return true;
    }
    void set(Mode mode) {
        const std::scoped_lock lock(mutex_);
        mode_ = mode;
    }
    std::uint64_t states() const {
        const std::scoped_lock lock(mutex_);
        return states_;
    }
    int snapshots() const {
        const std::scoped_lock lock(mutex_);
        return snapshots_;
    }
    std::set<BrickIndex> lost() const {
        const std::scoped_lock lock(mutex_);
        return lost_;
    }
    std::set<BrickIndex> told_whole() const {
        const std::scoped_lock lock(mutex_);
        return told_whole_;
    }

  private:
    glm::ivec3 size_bricks_{0};
    mutable std::mutex mutex_;
    Mode mode_ = Mode::watch;
    std::uint64_t states_ = 0;
    int snapshots_ = 0;
    std::set<BrickIndex> lost_;
    std::set<BrickIndex> told_whole_;
};

class BoneRepairTest : public ::testing::Test {
  protected:
    /// Lets the session's time go on, while no thread carves.
    LinkUpdate look() {
        served_.carve(0);
        return link_.poll();
    }
    void go_live() {
        ASSERT_TRUE(eventually([this] { return look().frames > 0; }));
    }
    /// Carves a few bricks and lets the client know less of it than it should.
    void carve_behind_its_back(Meddler::Mode mode) {
        meddler_.set(mode);
        served_.carve(5);
        ASSERT_TRUE(eventually([this] {
            look();
            return !meddler_.lost().empty();
        }));
        const std::uint64_t states = meddler_.states();
        ASSERT_TRUE(eventually([&] {
            look();
            return meddler_.states() > states + 2;
        }));
        meddler_.set(Meddler::Mode::watch);
    }
    void expect_equal_after_one_repair() {
        EXPECT_TRUE(eventually([this] { return look().repairs == 1; }));
        EXPECT_EQ(checksum(*link_.bone()), checksum(served_.bone()));
        EXPECT_EQ(meddler_.told_whole(), meddler_.lost()) << "these bricks crossed the wire and no others";
        const LinkUpdate update = link_.poll();
        EXPECT_EQ(update.bricks_repaired, meddler_.lost().size());
        EXPECT_EQ(update.connections, 1U);
        EXPECT_EQ(update.status, LinkStatus::live);
        EXPECT_EQ(meddler_.snapshots(), 1);
    }

    ServedBone served_;
    Meddler meddler_;
    FrameProxy proxy_{served_.port(), [this](v2::ServerFrame& frame) { return meddler_(frame); }};
    BoneLink link_{"127.0.0.1", proxy_.port()};
};

TEST_F(BoneRepairTest, AsksForTheBricksThatFramesWhichWereLostToldOf) {
    go_live();
    carve_behind_its_back(Meddler::Mode::drop_states);
    expect_equal_after_one_repair();
    EXPECT_EQ(link_.poll().rejected_frames, 1U) << "one gap";
}

TEST_F(BoneRepairTest, AsksForTheOneBrickThatMakesTheChecksumDiffer) {
    go_live();
    carve_behind_its_back(Meddler::Mode::drop_one_brick);
    expect_equal_after_one_repair();
    EXPECT_EQ(link_.poll().checksum_mismatches, 1U);
    EXPECT_EQ(link_.poll().bricks_repaired, 1U);
}

TEST_F(BoneRepairTest, RepairsWhileCarvingGoesOn) {
    go_live();
    served_.start_carving();
    meddler_.set(Meddler::Mode::drop_states);
    EXPECT_TRUE(eventually([this] { return !meddler_.lost().empty(); }));
    meddler_.set(Meddler::Mode::watch);
    EXPECT_TRUE(eventually([this] { return link_.poll().repairs == 1; }));
    EXPECT_EQ(link_.poll().connections, 1U);
    std::thread stopping([this] { served_.stop(); });
    EXPECT_TRUE(eventually([this] { return link_.poll().status == LinkStatus::finished; }));
    stopping.join();
    EXPECT_EQ(checksum(*link_.bone()), served_.mirror_checksum());
    EXPECT_EQ(link_.poll().checksum_mismatches, 0U);
}

}  // namespace
}  // namespace osteomill
