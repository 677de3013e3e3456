// A soft structure from the server's watch over a socket to a client.
#include <gtest/gtest.h>

#include "haptic_server/streaming/live_session.h"
#include "haptic_server/streaming/streaming_server.h"
#include "render_client/link/bone_link.h"
#include "tests/support/ball_structure.h"
#include "tests/support/block.h"
#include "tests/support/eventually.h"

namespace osteomill {
namespace {

TEST(LiveStructures, ComeToAClientWithTheirDistance) {
    const Bone bone = testing::make_block({0, 0, 0}, {4, 4, 4}, 0.1);
    Scene scene;
    scene.burrs = {Burr{.name = "round", .diameter_mm = 2.0}};
    scene.tissues = {Tissue{.label = 1, .name = "bone"},
                     Tissue{.label = 2, .name = "nerve", .is_protected = true, .warn_mm = 1.0}};
    const glm::dvec3 middle_mm = centre_of_voxel_mm(bone.grid(), bone.grid().size_voxels / 2);
    const std::vector<Structure> nerve{{1, testing::ball_mask(bone.grid(), middle_mm, 0.8)}};
    TripleBuffer<ToolState> tool;
    ChangeQueue changes(1 << 10, bone.shared_content());
    LiveSession session(tool, changes);
    session.watch(StructureWatch(nerve, scene.tissues, scene.burrs), scene.tissues);
    StreamingServer server({.port = 0}, session_info(scene, false, 3.3, "0.0.test"), bone, session, nullptr,
                           nerve);
    server.start();

    BoneLink link("127.0.0.1", server.port());
    std::vector<Structure> arrived;
    std::vector<StructureDistance> distances;
    double time_s = 0.0;
    const auto comes_true = [&](double distance_mm, auto&& is_so) {
        return testing::eventually([&] {
            tool.back() = {.time_s = time_s += 0.01,
                           .burr_position_mm = middle_mm + glm::dvec3(0.0, 0.0, 0.8 + 1.0 + distance_mm)};
            tool.publish();
            LinkUpdate update = link.poll();
            for (Structure& structure : update.structures) arrived.push_back(std::move(structure));
            distances = update.distances;
            return is_so();
        });
    };
    EXPECT_TRUE(comes_true(1.2, [&] { return distances.size() == 1 && !arrived.empty(); }));
    ASSERT_EQ(arrived.size(), 1u);
    EXPECT_EQ(arrived[0].tissue, 1u);
    EXPECT_TRUE(arrived[0].mask == nerve[0].mask);
    EXPECT_EQ(distances[0].tissue, 1u);
    EXPECT_NEAR(*distances[0].distance_mm, 1.2, 0.1) << "half a voxel, and the ball is made of cubes";
    EXPECT_TRUE(comes_true(-0.3, [&] { return !distances.empty() && distances[0].touches; }));
    EXPECT_TRUE(comes_true(9.0, [&] { return !distances.empty() && !distances[0].distance_mm; }));
    EXPECT_EQ(distances[0].touches_so_far, 1u);
    EXPECT_GT(distances[0].entered_mm3, 0.0);
    server.stop();
}

}  // namespace
}  // namespace osteomill
