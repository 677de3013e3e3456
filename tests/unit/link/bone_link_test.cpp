#include "render_client/link/bone_link.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <thread>

#include "common/recording/playhead.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/served_bone.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::bone_link_test {
namespace {

using testing::eventually;
using testing::ServedBone;

bool reaches(BoneLink& link, LinkStatus status) {
    return eventually([&] { return link.poll().status == status; });
}

bool verifies(BoneLink& link, std::uint64_t checksums) {
    return eventually([&] { return link.poll().checksums_verified >= checksums; });
}

/// Ends the session and expects every link to hold the bone that the server leaves, bit for bit.
void expect_equal_at_the_end(ServedBone& served, std::initializer_list<BoneLink*> links) {
    std::thread stopping([&] { served.stop(); });
    EXPECT_TRUE(eventually([&] {
        return std::ranges::count_if(links, [](BoneLink* link) {
                   return link->poll().status == LinkStatus::finished;
               }) == static_cast<std::ptrdiff_t>(links.size());
    }));
    stopping.join();
    EXPECT_EQ(served.mirror_checksum(), checksum(served.bone()));
    for (BoneLink* link : links) {
        EXPECT_EQ(checksum(*link->bone()), served.mirror_checksum());
        EXPECT_EQ(link->poll().checksum_mismatches, 0U);
        EXPECT_EQ(link->poll().rejected_frames, 0U);
    }
}

TEST(BoneLink, KeepsTheBoneEqualWhileItIsCarved) {
    ServedBone served;
    BoneLink link("127.0.0.1", served.port());
    ASSERT_TRUE(reaches(link, LinkStatus::live));
    served.start_carving();
    EXPECT_TRUE(verifies(link, 3));
    expect_equal_at_the_end(served, {&link});
}

TEST(BoneLink, SaysWhoTheServerIs) {
    ServedBone served(0, true);
    BoneLink link("127.0.0.1", served.port());
    EXPECT_EQ(link.session(), nullptr);
    EXPECT_EQ(link.bone(), nullptr);
    ASSERT_TRUE(reaches(link, LinkStatus::live));
    ASSERT_NE(link.session(), nullptr);
    EXPECT_EQ(link.session()->scene_name, "test scene");
    EXPECT_EQ(link.session()->server_version, "0.0.test");
    ASSERT_EQ(link.session()->burrs.size(), 2U);
    EXPECT_EQ(link.session()->burrs[0].diameter_mm, 1.5);
    ASSERT_EQ(link.session()->tissues.size(), 1U);
    EXPECT_TRUE(link.session()->tissues[0].is_protected);
    EXPECT_TRUE(link.session()->accepts_operator);
    EXPECT_EQ(link.session()->force_limit_n, 3.3);
}

TEST(BoneLink, NamesTheBricksThatChangedAndTheNewestTool) {
    ServedBone served;
    BoneLink link("127.0.0.1", served.port());
    bool was_replaced = false;
    ASSERT_TRUE(eventually([&] {
        const LinkUpdate update = link.poll();
        was_replaced = was_replaced || update.bone_replaced;
        return update.status == LinkStatus::live;
    }));
    EXPECT_TRUE(was_replaced);

    Bone shown = *link.bone();
    std::optional<ToolState> tool;
    served.start_carving();
    const auto follow = [&] {
        const LinkUpdate update = link.poll();
        EXPECT_FALSE(update.bone_replaced);
        EXPECT_TRUE(std::ranges::is_sorted(update.changes, {}, &BrickChange::brick));
        for (const auto& [brick, voxels, kind] : update.changes) {
            const std::int32_t slot = shown.slot(brick);
            for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel)
                if (voxels[voxel]) shown.fractions(slot)[voxel] = link.bone()->fractions(slot)[voxel];
        }
        if (update.tool) tool = update.tool;
        return update;
    };
    EXPECT_TRUE(eventually([&] { return follow().checksums_verified >= 2; }));
    served.stop();
    EXPECT_TRUE(eventually([&] { return follow().status == LinkStatus::finished; }));
    EXPECT_EQ(checksum(shown), checksum(*link.bone())) << "a brick changed that was not named";
    ASSERT_TRUE(tool);
    EXPECT_GT(tool->time_s, 0.0);
    EXPECT_EQ(tool->force_n, glm::dvec3(0.5, 0, 0));
}

TEST(BoneLink, MayJoinLateAndWithOthers) {
    ServedBone served;
    served.start_carving();
    BoneLink early("127.0.0.1", served.port());
    ASSERT_TRUE(verifies(early, 2));
    BoneLink late("127.0.0.1", served.port());
    ASSERT_TRUE(verifies(late, 2));
    {
        BoneLink passing("127.0.0.1", served.port());
        ASSERT_TRUE(verifies(passing, 1));
    }
    expect_equal_at_the_end(served, {&early, &late});
}

TEST(BoneLink, CatchesUpAfterTheWindowStoodStill) {
    ServedBone served;
    BoneLink link("127.0.0.1", served.port());
    BoneLink watch("127.0.0.1", served.port());
    ASSERT_TRUE(reaches(link, LinkStatus::live));
    served.start_carving();
    ASSERT_TRUE(eventually([&] { return watch.poll().frames > 100; }));  // more than the queue holds
    expect_equal_at_the_end(served, {&link, &watch});
}

TEST(BoneLink, WaitsForAServerThatIsNotThereYetAndReturnsAfterARestart) {
    std::uint16_t port = 0;
    {
        ServedBone first;
        port = first.port();
    }
    BoneLink link("127.0.0.1", port);
    EXPECT_TRUE(
        eventually([&] { return link.poll().status_line.find("trying again") != std::string::npos; }));
    EXPECT_EQ(link.poll().status, LinkStatus::connecting);
    {
        ServedBone second(port);
        second.start_carving();
        ASSERT_TRUE(verifies(link, 1));
        expect_equal_at_the_end(second, {&link});
    }
    EXPECT_NE(link.bone(), nullptr) << "a finished session leaves its bone";

    ServedBone third(port, false, 99);
    ASSERT_TRUE(reaches(link, LinkStatus::live));
    third.start_carving();
    ASSERT_TRUE(verifies(link, 2));
    expect_equal_at_the_end(third, {&link});
    EXPECT_EQ(link.poll().connections, 2U);
}

TEST(BoneLink, MovesToAnotherServer) {
    ServedBone here;
    ServedBone there(0, true);
    BoneLink link("127.0.0.1", here.port());
    ASSERT_TRUE(reaches(link, LinkStatus::live));
    EXPECT_FALSE(link.session()->accepts_operator);
    link.connect_to({"127.0.0.1", there.port()});
    ASSERT_TRUE(eventually([&] { return link.poll().connections == 2; }));
    ASSERT_TRUE(reaches(link, LinkStatus::live));
    EXPECT_TRUE(link.session()->accepts_operator);
}

TEST(BoneLink, LeavesSessionsAloneThatBeginUntilToldOtherwise) {
    std::optional<ServedBone> served(std::in_place);
    const std::uint16_t port = served->port();
    BoneLink link("127.0.0.1", port);
    ASSERT_TRUE(reaches(link, LinkStatus::live));
    link.leave_alone(true);
    served->start_carving();
    ASSERT_TRUE(verifies(link, 2)) << "one that was joined goes on";
    expect_equal_at_the_end(*served, {&link});
    served.reset();
    served.emplace(port);
    // It would have tried five times by now.
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(2);
    while (std::chrono::steady_clock::now() < end) {
        EXPECT_EQ(link.poll().status, LinkStatus::finished);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_EQ(link.poll().connections, 1U);
    link.leave_alone(false);
    ASSERT_TRUE(reaches(link, LinkStatus::live));
    EXPECT_EQ(link.poll().connections, 2U);
}

TEST(BoneLink, CarriesTheOperatorsWishes) {
    ServedBone served(0, true);
    auto link = std::make_unique<BoneLink>("127.0.0.1", served.port());
    ASSERT_TRUE(reaches(*link, LinkStatus::live));
    const OperatorCommand command{
        .hand_target_mm = {1, 2, 3}, .spindle_axis = {0, 0, 2}, .pedal = true, .burr = 1};
    EXPECT_TRUE(eventually([&] {
        link->poll();
        link->send_operator(command);
        return served.operator_command().has_value();
    }));
    EXPECT_EQ(served.operator_command()->hand_target_mm, glm::dvec3(1, 2, 3));
    EXPECT_EQ(served.operator_command()->spindle_axis, glm::dvec3(0, 0, 1));

    link->send_operator({.burr = 7});  // not sent: it would cost the connection
    BoneLink second("127.0.0.1", served.port());
    ASSERT_TRUE(reaches(second, LinkStatus::live));
    for (int i = 0; i < 10; ++i) second.send_operator({.burr = 0});
    // However long that takes: who asks for nothing for 3 s loses the lease.
    ASSERT_TRUE(eventually([&] {
        link->send_operator(command);
        return second.poll().checksums_verified >= 2;
    }));
    EXPECT_EQ(served.operator_command()->burr, 1U) << "the first holds the lease";
    const auto is_told = [&](BoneLink& client, ToolDriver driver) {
        return eventually([&] {
            link->send_operator(command);
            const auto tool = client.poll().tool;
            return tool && tool->driver == driver;
        });
    };
    EXPECT_TRUE(is_told(second, ToolDriver::another));
    EXPECT_TRUE(is_told(*link, ToolDriver::you));
    EXPECT_EQ(link->poll().connections, 1U);

    link.reset();
    EXPECT_TRUE(eventually([&] { return !served.operator_command().has_value(); }));
    EXPECT_TRUE(eventually([&] {
        second.send_operator({.burr = 0});
        return served.operator_command().has_value();
    })) << "the lease is free again";
}

/// Reads a recording to its end, every checksum with it.
Playhead at_its_end(const std::filesystem::path& file) {
    Playhead playhead(file);
    while (playhead.step(std::numeric_limits<double>::infinity()) != Playhead::Step::end) {
    }
    return playhead;
}

TEST(BoneLink, RecordsWhatItReceivesOverSeveralSessions) {
    const testing::TemporaryFolder folder;
    std::uint64_t left = 0;
    std::uint16_t port = 0;
    {
        auto first = std::make_unique<ServedBone>();
        port = first->port();
        BoneLink link("127.0.0.1", port, folder / "a.pcap");
        first->start_carving();
        ASSERT_TRUE(verifies(link, 2));
        expect_equal_at_the_end(*first, {&link});
        first.reset();
        ServedBone second(port, false, 99);
        ASSERT_TRUE(reaches(link, LinkStatus::live));
        second.start_carving();
        ASSERT_TRUE(verifies(link, 4));
        expect_equal_at_the_end(second, {&link});
        left = second.mirror_checksum();
        EXPECT_EQ(link.finish(), "");
    }
    const Playhead end = at_its_end(folder / "a.pcap");
    EXPECT_EQ(end.bone_checksum(), left);
    EXPECT_GE(end.counts().checksums_verified, 4U);
}

TEST(BoneLink, SaysThatItsRecordingEndedAndGoesOnWithoutIt) {
    const testing::TemporaryFolder folder;
    ServedBone served;
    served.start_carving();
    std::optional<BoneLink> link;
    {
        const testing::FileSizeLimit disk(500'000);
        link.emplace("127.0.0.1", served.port(), folder / "a.pcap");
        EXPECT_TRUE(eventually([&] { return !link->poll().recording_error.empty(); }));
    }
    EXPECT_TRUE(verifies(*link, 2));
    EXPECT_THAT(link->finish(), ::testing::AllOf(::testing::HasSubstr("a.part.pcap: no more than "),
                                                 ::testing::HasSubstr("which packet_replay reads")));
    EXPECT_THROW(BoneLink("127.0.0.1", served.port(), "/nowhere/a.pcap"), RecordingError);
}

TEST(BoneLink, SaysThatAHostCannotBeFound) {
    BoneLink link("no-such-host.invalid", 7010);
    EXPECT_TRUE(eventually([&] {
        return link.poll().status_line.find("cannot find no-such-host.invalid") != std::string::npos;
    }));
}

}  // namespace
}  // namespace osteomill::bone_link_test
