#include "render_client/volume/textures/visible_bone.h"

#include <gtest/gtest.h>

#include <array>

#include "studies/render/made_bone.h"

namespace osteomill::visible_bone_test {
namespace {

const Grid grid{.size_voxels = {32, 32, 32}};

Bone labelled() {
    return made_bone(
        grid, [](const glm::dvec3& p) { return 2.55 - p.z; },
        [](const glm::dvec3& p) { return static_cast<std::uint8_t>(p.x > 1.5 ? 1 : 2); });
}

TEST(VisibleBone, LacksWhatIsHiddenAndFollowsCarving) {
    Bone bone = labelled();
    const std::array<TissueColour, 2> tissues{{{1, {255, 0, 0}, 0.0}, {2, {0, 255, 0}}}};
    const TransferTable table = transfer_table(bone.content(), tissues, {});
    ASSERT_TRUE(hides_bone(table));
    VisibleBone visible(bone, table);
    const auto expect_no_hidden = [&] {
        for (int x : {3, 14, 15, 16, 28})
            for (int z : {2, 20, 25, 26}) {
                const glm::ivec3 voxel(x, 9, z);
                EXPECT_EQ(visible.bone().fraction_at(voxel), x > 15 ? 0 : bone.fraction_at(voxel))
                    << x << ' ' << z;
            }
    };
    expect_no_hidden();
    visible.follow(bone, carve_sphere(bone, {1.4, 0.9, 2.4}, 0.6));
    expect_no_hidden();
    EXPECT_EQ(bone.fraction_at({15, 9, 25}), 0);
}

TEST(VisibleBone, IsPeeledSmoothlyByARampOfOpacity) {
    const Bone bone = made_bone(grid, [](const glm::dvec3& p) { return 2.55 - p.z; });
    const ShadingSettings half{.transfer =
                                   TransferFunction{.name = "half", .points = {{1.0, {9, 9, 9}, 0.5}}}};
    const VisibleBone visible(bone, transfer_table(bone.content(), {}, half));
    EXPECT_EQ(visible.bone().fraction_at({5, 5, 5}), 128);
}

TEST(VisibleBone, KeepsTheSoftRimOfHardBoneAcrossBricks) {
    // Stiff bone up to z = 1.5 mm (voxel 15, a brick's last), a soft rim of one voxel, soft bone above.
    BoneBuilder builder = BoneBuilder::heterogeneous(grid, 0.02, false);
    for (int z = 0; z < 2; ++z)
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 2; ++x) {
                ByteBrick fraction{}, stiffness{};
                fraction.fill(255);
                stiffness.fill(z == 0 ? 100 : 10);
                builder.add_brick({x, y, z}, fraction, &stiffness, nullptr);
            }
    const Bone bone = std::move(builder).build();
    const ShadingSettings hard{.transfer = ct_window(1600.0, 1500.0)};
    const VisibleBone visible(bone, transfer_table(bone.content(), {}, hard));
    EXPECT_EQ(visible.bone().fraction_at({5, 5, 15}), 255);
    EXPECT_EQ(visible.bone().fraction_at({5, 5, 16}), 255) << "beside hard bone";
    EXPECT_EQ(visible.bone().fraction_at({5, 5, 17}), 0);
}

TEST(ShadingSettings, TakesTissuesUnlessATransferFunctionIsGiven) {
    const Bone bone = labelled();
    EXPECT_EQ(transfer_table(bone.content(), {}, {}).codes.channel, BoneChannel::tissue);
    EXPECT_FALSE(hides_bone(transfer_table(bone.content(), {}, {})));
    // Homogeneous: all bone has one stiffness, so one look.
    const TransferTable table = transfer_table(bone.content(), {}, {.transfer = transfer_presets()[0]});
    EXPECT_FALSE(table.codes.exist());
    EXPECT_EQ(table.by_code[0], look_of(transfer_presets()[0], 1.0));
    EXPECT_THROW(transfer_table(bone.content(), {}, {.transfer = TransferFunction{.name = "empty"}}),
                 std::invalid_argument);
}

TEST(ShadingSettings, SeesThroughATissueThatLetsSomeLightPass) {
    const std::array<TissueColour, 2> tissues{{{1, {255, 0, 0}, 0.4}, {2, {0, 255, 0}, 0.0}}};
    const TransferTable table = transfer_table(labelled().content(), tissues, {});
    EXPECT_EQ(table.mode, TransferMode::translucent);
    const auto parts = shown_part_by_code(table);
    EXPECT_EQ(parts[1], 255) << "seen through, but there";
    EXPECT_EQ(parts[2], 0);
    EXPECT_EQ(parts[0], 255) << "bone without a label";
}

}  // namespace
}  // namespace osteomill::visible_bone_test
