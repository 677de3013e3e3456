#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "imaging/phantoms/phantom.h"
#include "imaging/phantoms/tooth_shape.h"
#include "tests/unit/imaging/phantoms/made_bones.h"

namespace osteomill {
namespace {

constexpr std::array<glm::ivec3, 6> sides{glm::ivec3(-1, 0, 0), glm::ivec3(1, 0, 0),  glm::ivec3(0, -1, 0),
                                          glm::ivec3(0, 1, 0),  glm::ivec3(0, 0, -1), glm::ivec3(0, 0, 1)};

const Bone& jaw() {
    static const Bone& bone = testing::made_bone("jaw");
    return bone;
}

/// The tissue there, or none (0).
DentalTissue at(const glm::ivec3& voxel) {
    return jaw().fraction_at(voxel) == 0 ? DentalTissue{} : static_cast<DentalTissue>(jaw().tissue_at(voxel));
}

template <typename Visit>
void for_each_voxel(const Visit& visit) {
    const BoneContent& content = jaw().content();
    for (std::size_t slot = 0; slot < content.brick_of_slot.size(); ++slot) {
        const glm::ivec3 first =
            brick_edge_voxels * brick_position(content.size_bricks, content.brick_of_slot[slot]);
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
            if (jaw().fractions(static_cast<std::int32_t>(slot))[offset] > 0)
                visit(first + voxel_in_brick(offset),
                      static_cast<DentalTissue>(content.tissue[slot][offset]));
    }
}

bool is_of_tooth(DentalTissue tissue) {
    return tissue == DentalTissue::enamel || tissue == DentalTissue::dentine ||
           tissue == DentalTissue::pulp || tissue == DentalTissue::carious_lesion;
}
bool is_of_bone(DentalTissue tissue) {
    return tissue == DentalTissue::cortical_bone || tissue == DentalTissue::trabecular_bone ||
           tissue == DentalTissue::nerve_canal;
}

TEST(JawPhantom, HasTheVolumesOfAnatomy) {
    const auto volume = bone_volume_by_tissue_mm3(jaw());
    EXPECT_EQ(volume[0], 0.0) << "all is labelled";
    const auto of = [&](DentalTissue tissue) { return volume[static_cast<std::size_t>(tissue)]; };
    // Pulps of canine, premolars and molars (Fanibunda 1986, Int Endod J 19:194): 14, 15, 15, 53 and 32 mm^3.
    EXPECT_NEAR(of(DentalTissue::pulp), 129.0, 0.35 * 129.0);
    // A block as wide, deep and long as crown and cervix are by the table, of which a tooth fills 0.5 to
    // 0.75.
    double blocks_mm3 = 0.0;
    for (const ToothShape& tooth : lower_left_teeth()) {
        double root_mm = 0.0;
        for (const RootPiece& root : tooth.roots)
            root_mm = std::max(root_mm, root.to_radius_mm - root.to_mm.z);
        blocks_mm3 += tooth.crown_width_mm * tooth.crown_depth_mm * tooth.crown_mm +
                      tooth.cervix_width_mm * tooth.cervix_depth_mm * root_mm;
    }
    const double teeth_mm3 = of(DentalTissue::enamel) + of(DentalTissue::dentine) + of(DentalTissue::pulp) +
                             of(DentalTissue::carious_lesion);
    EXPECT_GT(teeth_mm3, 0.5 * blocks_mm3);
    EXPECT_LT(teeth_mm3, 0.75 * blocks_mm3);
    // Enamel is a third to a half of the crown, so a fifth to a third of the tooth.
    EXPECT_GT(of(DentalTissue::enamel), 0.2 * teeth_mm3);
    EXPECT_LT(of(DentalTissue::enamel), 0.33 * teeth_mm3);
    // A tube of 2.6 mm where it is widest and 1.6 where it is narrowest, 46 mm long.
    const auto tube_mm3 = [](double width_mm) { return std::numbers::pi / 4.0 * width_mm * width_mm * 46.0; };
    EXPECT_GT(of(DentalTissue::nerve_canal), tube_mm3(1.6));
    EXPECT_LT(of(DentalTissue::nerve_canal), tube_mm3(2.7));
    EXPECT_GT(of(DentalTissue::carious_lesion), 12.0);
    EXPECT_LT(of(DentalTissue::carious_lesion), 35.0);
}

TEST(JawPhantom, TeethAreAsLongAndWideAsTheTableSays) {
    for (const ToothShape& tooth : lower_left_teeth()) {
        glm::dvec3 low(100.0), high(-100.0);
        double cervix = 0.0;
        constexpr double step_mm = 0.1;
        glm::dvec3 p;
        for (p.z = -18.0; p.z < 13.0; p.z += step_mm)
            for (p.y = -6.0; p.y < 6.0; p.y += step_mm)
                for (p.x = -7.0; p.x < 7.0; p.x += step_mm) {
                    if (tooth_distance_mm(tooth, p) > 0.0) continue;
                    low = glm::min(low, p);
                    high = glm::max(high, p);
                    if (std::abs(p.z) < 0.5 * step_mm) cervix = std::max(cervix, 2.0 * std::abs(p.x));
                }
        EXPECT_NEAR(high.z, tooth.crown_mm, 0.5);
        EXPECT_NEAR(high.x - low.x, tooth.crown_width_mm, 0.5) << tooth.crown_mm;
        EXPECT_NEAR(high.y - low.y, tooth.crown_depth_mm, 0.6) << tooth.crown_mm;
        EXPECT_NEAR(cervix, tooth.cervix_width_mm, 1.2) << tooth.crown_mm;
    }
}

TEST(JawPhantom, PulpLiesWithinDentine) {
    for_each_voxel([](const glm::ivec3& voxel, DentalTissue tissue) {
        if (tissue != DentalTissue::pulp) return;
        for (const glm::ivec3& side : sides) {
            const DentalTissue beside = at(voxel + side);
            ASSERT_TRUE(beside == DentalTissue::pulp || beside == DentalTissue::dentine)
                << static_cast<int>(beside) << " at " << voxel.x << " " << voxel.y << " " << voxel.z;
        }
    });
}

TEST(JawPhantom, AGapSeparatesEveryToothFromTheBone) {
    for_each_voxel([](const glm::ivec3& voxel, DentalTissue tissue) {
        if (!is_of_tooth(tissue)) return;
        for (const glm::ivec3& side : sides)
            ASSERT_FALSE(is_of_bone(at(voxel + side))) << voxel.x << " " << voxel.y << " " << voxel.z;
    });
}

TEST(JawPhantom, TheNerveLiesWithinBoneFromEndToEnd) {
    int first_y = 1000, last_y = 0;
    std::vector<glm::ivec3> nerve;
    for_each_voxel([&](const glm::ivec3& voxel, DentalTissue tissue) {
        if (tissue != DentalTissue::nerve_canal) return;
        nerve.push_back(voxel);
        first_y = std::min(first_y, voxel.y);
        last_y = std::max(last_y, voxel.y);
    });
    EXPECT_NEAR(centre_of_voxel_mm(jaw().grid(), {0, first_y, 0}).y, -28.0, 0.2);
    EXPECT_NEAR(centre_of_voxel_mm(jaw().grid(), {0, last_y, 0}).y, 18.0, 0.2);
    std::vector<bool> is_in_slice(static_cast<std::size_t>(last_y) + 1);
    for (const glm::ivec3& voxel : nerve) {
        is_in_slice[static_cast<std::size_t>(voxel.y)] = true;
        for (const glm::ivec3& side : sides) {
            if (side.y != 0) continue;
            const DentalTissue beside = at(voxel + side);
            ASSERT_TRUE(beside == DentalTissue::nerve_canal || beside == DentalTissue::cortical_bone)
                << static_cast<int>(beside) << " at " << voxel.x << " " << voxel.y << " " << voxel.z;
        }
    }
    for (int y = first_y; y <= last_y; ++y) EXPECT_TRUE(is_in_slice[static_cast<std::size_t>(y)]) << y;
}

TEST(JawPhantom, CariesIsSoftestInTheMiddleAndFarFromThePulp) {
    const Scene scene = phantom_scene("jaw");
    const Tissue& lesion = scene.tissues.at(6);
    ASSERT_EQ(lesion.name, "carious lesion");
    std::vector<glm::dvec3> lesions, pulps;
    double softest = 10.0, hardest = 0.0;
    for_each_voxel([&](const glm::ivec3& voxel, DentalTissue tissue) {
        const glm::dvec3 p = centre_of_voxel_mm(jaw().grid(), voxel);
        if (tissue == DentalTissue::pulp && p.y > -6.0 && p.y < 6.0 && p.z > 0.0) pulps.push_back(p);
        if (tissue != DentalTissue::carious_lesion) return;
        lesions.push_back(p);
        softest = std::min(softest, jaw().stiffness_at(voxel));
        hardest = std::max(hardest, jaw().stiffness_at(voxel));
    });
    EXPECT_LT(softest, 0.25);
    EXPECT_GT(hardest, 0.7);
    double nearest = 100.0;
    for (const glm::dvec3& a : lesions)
        for (const glm::dvec3& b : pulps) nearest = std::min(nearest, glm::distance(a, b));
    EXPECT_GT(nearest, 0.8) << "else drilling it out would open the pulp";
    EXPECT_LT(nearest, 2.5) << "a deep lesion";
}

TEST(JawPhantom, IsTheSameBoneEverywhereInUnder60Megabytes) {
    const Bone again = testing::make_bone("jaw");
    EXPECT_EQ(checksum(again), checksum(jaw()));
    EXPECT_EQ(again.content().tissue, jaw().content().tissue);
    EXPECT_EQ(again.content().stiffness, jaw().content().stiffness);
    EXPECT_LT(memory_bytes(jaw()), 60'000'000U);
}

}  // namespace
}  // namespace osteomill
