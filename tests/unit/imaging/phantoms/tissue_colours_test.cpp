#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "imaging/phantoms/phantom.h"
#include "tests/support/colour_difference.h"
#include "tests/unit/imaging/phantoms/made_bones.h"

namespace osteomill {
namespace {

using testing::ciede2000;
using testing::least_difference;

TEST(ColourDifference, IsThatOfThePublishedPairs) {
    // Sharma, Wu and Dalal 2005, table 1: pairs 1, 4, 7, 9, 17, 20, 25 and 34.
    struct Pair {
        glm::dvec3 a, b;
        double difference;
    };
    for (const Pair& pair : {Pair{{50.0, 2.6772, -79.7751}, {50.0, 0.0, -82.7485}, 2.0425},
                             Pair{{50.0, -1.3802, -84.2814}, {50.0, 0.0, -82.7485}, 1.0000},
                             Pair{{50.0, 0.0, 0.0}, {50.0, -1.0, 2.0}, 2.3669},
                             Pair{{50.0, 2.49, -0.001}, {50.0, -2.49, 0.0009}, 7.1792},
                             Pair{{50.0, 2.5, 0.0}, {73.0, 25.0, -18.0}, 27.1492},
                             Pair{{50.0, 2.5, 0.0}, {58.0, 24.0, 15.0}, 19.4535},
                             Pair{{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
                             Pair{{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082}}) {
        EXPECT_NEAR(ciede2000(pair.a, pair.b), pair.difference, 5e-5);
        EXPECT_NEAR(ciede2000(pair.b, pair.a), pair.difference, 5e-5);
    }
}

TEST(ColourDifference, IsSmallOfRedAndGreenToWhomTheyAreOne) {
    // Ishihara's colours have about the same lightness.
    EXPECT_LT(least_difference({180, 100, 60}, {120, 130, 60}), 12.0);
    EXPECT_GT(least_difference({0, 0, 0}, {255, 255, 255}), 90.0);
    EXPECT_EQ(least_difference({10, 20, 30}, {10, 20, 30}), 0.0);
}

/// Pairs of labels that share at least so many sides of voxels.
std::set<std::pair<std::uint8_t, std::uint8_t>> tissues_in_touch(const Bone& bone, int least_sides) {
    std::map<std::pair<std::uint8_t, std::uint8_t>, int> sides;
    const BoneContent& content = bone.content();
    for (std::size_t slot = 0; slot < content.brick_of_slot.size(); ++slot) {
        const glm::ivec3 first =
            brick_edge_voxels * brick_position(content.size_bricks, content.brick_of_slot[slot]);
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
            if (bone.fractions(static_cast<std::int32_t>(slot))[offset] == 0) continue;
            const glm::ivec3 voxel = first + voxel_in_brick(offset);
            const std::uint8_t here = content.tissue[slot][offset];
            for (int axis = 0; axis < 3; ++axis) {
                glm::ivec3 next = voxel;
                ++next[axis];
                if (bone.fraction_at(next) == 0) continue;
                const std::uint8_t there = bone.tissue_at(next);
                if (there != here) ++sides[std::minmax(here, there)];
            }
        }
    }
    std::set<std::pair<std::uint8_t, std::uint8_t>> touching;
    for (const auto& [pair, count] : sides)
        if (count >= least_sides) touching.insert(pair);
    return touching;
}

TEST(TissueColours, OfTissuesInTouchAreToldApartByTheColourBlind) {
    for (const std::string name : {"jaw", "tooth", "mastoid"}) {
        const Scene scene = phantom_scene(name);
        const Bone& bone = testing::made_bone(name.c_str());
        const auto tissue_of = [&](std::uint8_t label) -> const Tissue& {
            return *std::ranges::find(scene.tissues, label, &Tissue::label);
        };
        for (const auto& [one, other] : tissues_in_touch(bone, 30)) {
            const Tissue &a = tissue_of(one), &b = tissue_of(other);
            // Round the neck of the single tooth two whites meet; no drilling tells them apart.
            if (name == "tooth" && a.name == "cortical bone" && b.name == "enamel") continue;
            EXPECT_GT(least_difference(a.colour_rgb, b.colour_rgb), 20.0)
                << name << ": " << a.name << " beside " << b.name;
        }
    }
}

}  // namespace
}  // namespace osteomill
