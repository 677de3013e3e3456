#include "imaging/phantoms/phantom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "common/scene/scene.h"
#include "common/scene/scene_file.h"
#include "imaging/phantoms/distance_fields.h"

namespace osteomill {
namespace {

const Bone& tooth_bone() {
    static const Bone bone =
        bone_from_hu(make_tooth_phantom(), phantom_threshold_hu, default_stiffness_relation());
    return bone;
}

TEST(ToothPhantom, IsTheSameBoneEverywhere) {
    // Bit for bit, with any optimisation: recordings refer to it.
    EXPECT_EQ(checksum(tooth_bone()), 0x5865b18f74375ff9U);
}

TEST(ToothPhantom, HasEveryTissueInPlausibleAmounts) {
    const auto volume = bone_volume_by_tissue_mm3(tooth_bone());
    EXPECT_EQ(volume[0], 0.0) << "all bone is labelled";
    const auto of = [&](DentalTissue tissue) { return volume[static_cast<std::size_t>(tissue)]; };
    EXPECT_GT(of(DentalTissue::cortical_bone), of(DentalTissue::trabecular_bone));
    EXPECT_NEAR(of(DentalTissue::dentine) + of(DentalTissue::enamel), 470.0, 100.0)
        << "a molar is about half a millilitre";
    EXPECT_NEAR(of(DentalTissue::pulp), 30.0, 15.0);
    EXPECT_NEAR(of(DentalTissue::nerve_canal), 3.14159 * 0.64 * 46.0, 10.0);
    EXPECT_NEAR(of(DentalTissue::carious_lesion), 19.0, 6.0);
}

TEST(ToothPhantom, FillsSurfaceVoxelsByTheirDistanceFromIt) {
    const Bone& bone = tooth_bone();
    const Grid& grid = bone.grid();
    int on_surface = 0;
    // The end of the jaw, far from tooth and nerve, is a box with rounded edges.
    for (int z = 0; z < grid.size_voxels.z; ++z)
        for (int y = 0; y < grid.size_voxels.y; ++y)
            for (int x = 420; x < grid.size_voxels.x; ++x) {
                const glm::dvec3 p = centre_of_voxel_mm(grid, {x, y, z});
                const double distance =
                    distance_field::rounded_box(p - glm::dvec3(0.0, 0.0, -5.1), {23.0, 7.5, 3.1}, 2.4) /
                    grid.spacing_mm;
                if (std::abs(distance) > 0.5) continue;
                ++on_surface;
                EXPECT_NEAR(bone.fraction_at({x, y, z}), 255.0 * (0.5 - distance), 4.0) << distance;
            }
    EXPECT_GT(on_surface, 10'000);
}

TEST(ToothPhantom, HasPlausibleStiffness) {
    const Bone& bone = tooth_bone();
    const auto stiffness = [&](const glm::dvec3& place_mm) {
        return bone.stiffness_at(glm::ivec3(to_voxel_coordinates(bone.grid(), place_mm) + 0.5));
    };
    EXPECT_NEAR(stiffness({0.0, -4.0, 1.5}), 2.16, 0.05) << "enamel";
    EXPECT_NEAR(stiffness({0.0, 0.0, 0.2}), 1.0, 0.05) << "dentine";
    EXPECT_NEAR(stiffness({0.5, 0.2, 2.0}), 0.21, 0.03) << "lesion";
    EXPECT_LT(stiffness({0.0, 0.0, -1.0}), 0.08) << "pulp";
}

TEST(ToothPhantom, LesionOpensAtTheTopAndLiesWithinTheHoleThatTheSceneDrills) {
    const Bone& bone = tooth_bone();
    const Scene scene = phantom_scene("tooth");
    const TrajectorySpec& hole = scene.trajectory;
    bool opens = false;
    for (int z = 0; z < 128; ++z)
        for (int y = 200; y < 312; ++y)
            for (int x = 200; x < 312; ++x) {
                if (bone.tissue_at({x, y, z}) != static_cast<std::uint8_t>(DentalTissue::carious_lesion))
                    continue;
                if (bone.fraction_at({x, y, z}) == 0) continue;
                const glm::dvec3 p = centre_of_voxel_mm(bone.grid(), {x, y, z});
                EXPECT_LT(std::hypot(p.x - hole.start_mm.x, p.y - hole.start_mm.y), 0.5 * hole.width_mm);
                EXPECT_GT(p.z, hole.start_mm.z - hole.depth_mm - 0.05);
                if (bone.fraction_at({x, y, z + 1}) == 0) opens = true;
            }
    EXPECT_TRUE(opens);
}

TEST(ToothPhantom, StoresOnlyTheBricksThatHoldBone) {
    const Bone& bone = tooth_bone();
    constexpr std::size_t channels = 3;  // fraction, stiffness, tissue
    EXPECT_LT(bone.stored_bricks(), 32U * 32U * 8U / 5U) << "most of the grid is air";
    EXPECT_LT(memory_bytes(bone), (channels * bone.stored_bricks() + 16U) * sizeof(ByteBrick));
    EXPECT_LT(static_cast<double>(memory_bytes(bone)) / bone_volume_mm3(bone), 5000.0)
        << "bytes per mm^3, of which 1000 voxels in three channels are 3000";
}

TEST(CubePhantom, IsHomogeneousWithItsTopAtZero) {
    const Bone bone = bone_from_hu(make_cube_phantom(), phantom_threshold_hu, default_stiffness_relation());
    EXPECT_NEAR(bone_volume_mm3(bone), 50.0 * 50.0 * 12.0, 1e-6);
    EXPECT_TRUE(bone.content().stiffness.empty());
    EXPECT_TRUE(bone.content().tissue.empty());
    EXPECT_DOUBLE_EQ(bone.content().homogeneous_stiffness, 1.0);
    EXPECT_LT(memory_bytes(bone), 1.02 * 8192.0 * sizeof(ByteBrick)) << "one channel";
    const auto at = [&](double z) {
        return bone.fraction_at(glm::ivec3(to_voxel_coordinates(bone.grid(), {0.0, 0.0, z}) + 0.5));
    };
    EXPECT_EQ(at(-0.04), 255);
    EXPECT_EQ(at(0.06), 0);
}

/// CIE L*, 0 to 100, of an sRGB colour.
double lightness(const std::array<std::uint8_t, 3>& srgb) {
    const std::array<double, 3> weights{0.2126, 0.7152, 0.0722};
    double luminance = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double value = srgb[i] / 255.0;
        luminance += weights[i] * (value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
    }
    return luminance > 0.008856 ? 116.0 * std::cbrt(luminance) - 16.0 : 903.3 * luminance;
}

TEST(PhantomScenes, GiveTissuesColoursThatDifferInLightness) {
    std::vector<double> lightnesses;
    for (const Tissue& tissue : phantom_scene("tooth").tissues)
        lightnesses.push_back(lightness(tissue.colour_rgb));
    std::sort(lightnesses.begin(), lightnesses.end());
    for (std::size_t i = 1; i < lightnesses.size(); ++i) EXPECT_GE(lightnesses[i] - lightnesses[i - 1], 6.0);
}

TEST(PhantomScenes, AreTheOnesThatAreShippedAsFiles) {
    for (const std::string name : phantom_names)
        EXPECT_EQ(read_scene(REPOSITORY "/scenes/" + name + ".toml"), phantom_scene(name)) << name;
    EXPECT_THROW((void)phantom_scene("skull"), std::invalid_argument);
    EXPECT_THROW((void)make_phantom("skull"), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill
