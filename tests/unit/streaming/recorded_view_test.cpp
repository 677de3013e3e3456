// The operator's viewpoint, on its way from a window into a recording.
#include <gmock/gmock.h>

#include "common/recording/pcap_file.h"
#include "common/recording/playhead.h"
#include "common/wire/sealed_frame.h"
#include "render_client/link/bone_link.h"
#include "tests/support/served_bone.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using testing::eventually;
using testing::ServedBone;

Viewpoint at_x(double x_mm) {
    return {.eye_mm = {x_mm, -80.0, 40.0}};
}

/// The frames of a recording, as they are in the file.
std::vector<v2::ServerFrame> frames_of(const std::filesystem::path& file) {
    std::vector<v2::ServerFrame> frames;
    PacketReader packets(file);
    while (const auto packet = packets.next())
        frames.push_back(std::get<v2::ServerFrame>(open_frame(packet->message)));
    return frames;
}

std::vector<double> views_x_mm(const std::filesystem::path& file) {
    std::vector<double> views;
    for (const v2::ServerFrame& frame : frames_of(file))
        if (frame.state().has_view()) views.push_back(frame.state().view().eye_mm().x());
    return views;
}

class RecordedViewTest : public ::testing::Test {
  protected:
    std::unique_ptr<BoneLink> join() const {
        auto link = std::make_unique<BoneLink>("127.0.0.1", served_->port());
        EXPECT_TRUE(eventually([&] { return link->poll().status == LinkStatus::live; }));
        return link;
    }
    /// Waits until the link's messages are in the recording.
    bool holds(double x_mm) const {
        return eventually([&] {
            served_->carve(1);
            const std::vector<double> views = views_x_mm(part_);
            return !views.empty() && views.back() == x_mm;
        });
    }
    /// The link moves the tool from now on.
    bool takes_tool(BoneLink& link) const {
        return eventually([&] {
            served_->carve(1);  // so that there is something new to answer
            link.send_operator({.hand_target_mm = {1, 2, 3}});
            const auto tool = link.poll().tool;
            return tool && tool->driver == ToolDriver::you;
        });
    }

    const testing::TemporaryFolder folder_;
    const std::filesystem::path part_ = folder_ / "a.part.pcap";
    std::unique_ptr<ServedBone> served_ = std::make_unique<ServedBone>(
        0, true, 8, RecordTo{folder_ / "a.pcap", Stamp{std::chrono::seconds(1'700'000'000)}});
};

TEST_F(RecordedViewTest, IsSaidWhenItChangesAndStaysUntilThen) {
    const auto link = join();
    EXPECT_TRUE(link->session()->records_view);
    link->send_view(at_x(1.0));
    ASSERT_TRUE(holds(1.0));
    link->send_view(at_x(1.0));
    ASSERT_TRUE(eventually([&, until = frames_of(part_).size() + 10] {
        served_->carve(1);
        return frames_of(part_).size() >= until;
    }));
    link->send_view(at_x(2.0));
    ASSERT_TRUE(holds(2.0));
    served_->stop();
    EXPECT_EQ(views_x_mm(folder_ / "a.pcap"), (std::vector{1.0, 2.0}));

    Playhead playhead(folder_ / "a.pcap");
    std::vector<double> seen;
    while (playhead.step(std::numeric_limits<double>::infinity()) == Playhead::Step::state)
        if (playhead.state().view) seen.push_back(playhead.state().view->eye_mm.x);
    EXPECT_GT(seen.size(), 10U) << "every state behind the first has it";
    EXPECT_TRUE(std::ranges::is_sorted(seen));
    EXPECT_EQ(seen.back(), 2.0);
}

TEST_F(RecordedViewTest, IsThatOfWhoMovesTheTool) {
    const auto trainee = join();
    const auto teacher = join();
    teacher->send_view(at_x(9.0));
    ASSERT_TRUE(holds(9.0)) << "nobody moves the tool, and nobody else looks";
    trainee->send_view(at_x(1.0));
    ASSERT_TRUE(takes_tool(*trainee));
    ASSERT_TRUE(holds(1.0));
    teacher->send_view(at_x(8.0));
    trainee->send_view(at_x(2.0));
    ASSERT_TRUE(holds(2.0));
    served_->stop();
    EXPECT_THAT(views_x_mm(folder_ / "a.pcap"), ::testing::Not(::testing::Contains(8.0)));
}

TEST_F(RecordedViewTest, TakesNoByteWhereNobodyLooksAndGoesToNoClient) {
    const auto link = join();
    served_->carve(20);
    link->send_view(at_x(1.0));
    ASSERT_TRUE(holds(1.0));
    EXPECT_FALSE(link->poll().view) << "to clients it is not sent";
    const v2::ServerFrame hello = frames_of(part_).front();
    ASSERT_TRUE(hello.has_hello());
    EXPECT_FALSE(hello.hello().records_view()) << "a recording asks nobody";

    const ServedBone plain;
    BoneLink other("127.0.0.1", plain.port());
    ASSERT_TRUE(eventually([&] { return other.poll().status == LinkStatus::live; }));
    EXPECT_FALSE(other.session()->records_view) << "it records nothing";
    other.send_view(at_x(1.0));
    EXPECT_TRUE(eventually([&] { return other.poll().checksums_verified >= 2; })) << "and is told nothing";
    EXPECT_EQ(other.poll().connections, 1U);
}

}  // namespace
}  // namespace osteomill
