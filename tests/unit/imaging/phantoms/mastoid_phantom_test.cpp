#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <queue>
#include <sstream>
#include <string>
#include <vector>

#include "imaging/phantoms/phantom.h"
#include "imaging/phantoms/temporal_bone.h"
#include "tests/unit/imaging/phantoms/made_bones.h"

namespace osteomill {
namespace {

const Bone& temporal_bone() {
    static const Bone& bone = testing::made_bone("mastoid");
    return bone;
}

double volume_mm3(TemporalTissue tissue) {
    static const std::vector<double> volumes = bone_volume_by_tissue_mm3(temporal_bone());
    return volumes.at(static_cast<std::size_t>(tissue));
}

glm::ivec3 voxel_at(const glm::dvec3& place_mm) {
    return glm::ivec3(to_voxel_coordinates(temporal_bone().grid(), place_mm) + 0.5);
}

bool is_air(const glm::ivec3& voxel) {
    return temporal_bone().fraction_at(voxel) == 0;
}

/// Voxels that can be reached through those that `is_open`, from one.
template <typename IsOpen>
std::vector<bool> reached_from(const glm::ivec3& start, const IsOpen& is_open) {
    const glm::ivec3 size = temporal_bone().grid().size_voxels;
    const auto index = [&](const glm::ivec3& v) {
        return static_cast<std::size_t>(v.x) +
               static_cast<std::size_t>(size.x) *
                   (static_cast<std::size_t>(v.y) +
                    static_cast<std::size_t>(size.y) * static_cast<std::size_t>(v.z));
    };
    std::vector<bool> is_reached(index(size - 1) + 1);
    std::queue<glm::ivec3> next;
    next.push(start);
    is_reached[index(start)] = true;
    while (!next.empty()) {
        const glm::ivec3 at = next.front();
        next.pop();
        for (int axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                glm::ivec3 beside = at;
                beside[axis] += step;
                if (!contains(temporal_bone().grid(), beside) || is_reached[index(beside)] ||
                    !is_open(beside))
                    continue;
                is_reached[index(beside)] = true;
                next.push(beside);
            }
    }
    return is_reached;
}

std::size_t index_in_grid(const glm::ivec3& v) {
    const glm::ivec3 size = temporal_bone().grid().size_voxels;
    return static_cast<std::size_t>(v.x) +
           static_cast<std::size_t>(size.x) *
               (static_cast<std::size_t>(v.y) +
                static_cast<std::size_t>(size.y) * static_cast<std::size_t>(v.z));
}

TEST(MastoidPhantom, HasTheNamesIdentifiersAndLabelsOfFivrs) {
    std::ifstream table(REPOSITORY "/scenes/fivrs.ctbl");
    std::string line;
    std::size_t tissue = 0;
    const Scene scene = phantom_scene("mastoid");
    while (std::getline(table, line)) {
        if (line.starts_with("#")) continue;
        std::istringstream fields(line);
        int label = 0, red = 0, green = 0, blue = 0;
        std::string name;
        fields >> label >> name >> red >> green >> blue;
        ASSERT_LT(tissue, scene.tissues.size());
        const Tissue& ours = scene.tissues[tissue++];
        EXPECT_EQ(ours.label, label);
        EXPECT_EQ(ours.name, name);
        EXPECT_EQ(identifier_of(ours), (std::array<std::uint8_t, 3>{static_cast<std::uint8_t>(red),
                                                                    static_cast<std::uint8_t>(green),
                                                                    static_cast<std::uint8_t>(blue)}));
        EXPECT_GT(volume_mm3(static_cast<TemporalTissue>(label)), 0.0) << name;
    }
    EXPECT_EQ(tissue, scene.tissues.size());
}

TEST(MastoidPhantom, HasTheVolumesOfAnatomy) {
    EXPECT_EQ(volume_mm3(TemporalTissue{}), 0.0) << "all is labelled";
    // The mean weights of the three, 23, 27 and 3 mg, over the density of compact bone, 1.9 g/cm^3 and more.
    EXPECT_NEAR(volume_mm3(TemporalTissue::malleus), 12.5, 5.0);
    EXPECT_NEAR(volume_mm3(TemporalTissue::incus), 14.0, 5.0);
    EXPECT_NEAR(volume_mm3(TemporalTissue::stapes), 2.0, 1.2);
    // Perilymph and endolymph, 0.2 ml together.
    EXPECT_NEAR(volume_mm3(TemporalTissue::bony_labyrinth), 200.0, 70.0);
    // Nerve of 1.0 to 1.6 mm along 60 mm at most, geniculate ganglion included.
    EXPECT_GT(volume_mm3(TemporalTissue::facial_nerve), 30.0);
    EXPECT_LT(volume_mm3(TemporalTissue::facial_nerve), 100.0);
}

TEST(MastoidPhantom, CanalsHaveTheRadiiOfTheTable) {
    std::vector<double> radii_mm;
    for (const AnatomyPart& part : temporal_bone_parts())
        if (part.shape == AnatomyPart::Shape::ring) radii_mm.push_back(part.a_radius_mm);
    EXPECT_EQ(radii_mm, (std::vector{2.3, 3.1, 3.2}));
}

TEST(MastoidPhantom, AirGoesFromTheTympanicCavityToAntrumAndCellsAndNotThroughTheDrum) {
    const auto reached = reached_from(voxel_at({-2.5, -2.0, 0.0}), is_air);
    EXPECT_TRUE(reached[index_in_grid(voxel_at({1.4, 10.0, 6.4}))]) << "antrum";
    EXPECT_FALSE(reached[index_in_grid(voxel_at({8.0, -1.2, 0.8}))]) << "ear canal";
    EXPECT_FALSE(reached[index_in_grid(voxel_at({22.0, 12.0, 4.0}))]) << "outside";
    std::size_t air_voxels = 0;
    for (const bool is_reached : reached) air_voxels += is_reached ? 1 : 0;
    // Tympanic cavity, antrum and cells of adults: 4 to 16 ml or so in all.
    const double ml = 1e-3 * static_cast<double>(air_voxels) * voxel_volume_mm3(temporal_bone().grid());
    EXPECT_GT(ml, 1.5);
    EXPECT_LT(ml, 12.0);
}

TEST(MastoidPhantom, TheFacialNerveIsOnePieceFromTheInternalCanalToItsForamen) {
    const auto is_nerve = [](const glm::ivec3& v) {
        return !is_air(v) &&
               temporal_bone().tissue_at(v) == static_cast<std::uint8_t>(TemporalTissue::facial_nerve);
    };
    const glm::ivec3 at_foramen = voxel_at({1.2, 7.1, -14.0});
    ASSERT_TRUE(is_nerve(at_foramen));
    const auto reached = reached_from(at_foramen, is_nerve);
    EXPECT_TRUE(reached[index_in_grid(voxel_at({-4.4, 2.4, 4.1}))]) << "tympanic part";
    EXPECT_TRUE(reached[index_in_grid(voxel_at({-6.6, -4.4, 5.3}))]) << "first genu";
    EXPECT_TRUE(reached[index_in_grid(voxel_at({-18.0, -0.3, 4.7}))]) << "in the internal canal";
}

TEST(MastoidPhantom, OssiclesReachFromTheDrumToTheOvalWindow) {
    const auto is_ossicle = [](const glm::ivec3& v) {
        const std::uint8_t label = temporal_bone().tissue_at(v);
        return !is_air(v) && label >= 2 && label <= 4;
    };
    const auto reached = reached_from(voxel_at({-0.7, -0.8, 5.8}), is_ossicle);
    EXPECT_TRUE(reached[index_in_grid(voxel_at({-0.8, 1.5, 5.8}))]) << "incus";
    EXPECT_TRUE(reached[index_in_grid(voxel_at({-5.9, 1.9, 2.8}))]) << "footplate of the stapes";
}

TEST(MastoidPhantom, IsTheSameBoneEverywhere) {
    const Bone again = testing::make_bone("mastoid");
    EXPECT_EQ(checksum(again), checksum(temporal_bone()));
    EXPECT_EQ(again.content().tissue, temporal_bone().content().tissue);
    EXPECT_LT(memory_bytes(temporal_bone()), 80'000'000U);
}

}  // namespace
}  // namespace osteomill
