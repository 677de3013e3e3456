#include "imaging/picture/smooth_border.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "imaging/picture/bone_picture.h"
#include "studies/render/made_bone.h"
#include "tests/support/ball_structure.h"
#include "tests/support/labelled_cube.h"

namespace osteomill {
namespace {

constexpr VoxelBounds box{glm::ivec3(0), glm::ivec3(40)};
const glm::dvec3 centre(20.3, 21.2, 19.9);

/// The farthest place along a direction that the border holds, voxels from the centre.
double reaches(const SmoothBorder& border, const glm::dvec3& direction, double most) {
    double holds = 0.0;
    for (double t = 0.0; t <= most; t += 0.01)
        if (border.holds(centre + t * direction)) holds = t;
    return holds;
}

/// Spread evenly over the sphere.
std::vector<glm::dvec3> directions() {
    std::vector<glm::dvec3> all;
    constexpr int count = 200;
    for (int i = 0; i < count; ++i) {
        const double z = 2.0 * (i + 0.5) / count - 1.0;
        const double around = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const double r = std::sqrt(1.0 - z * z);
        all.emplace_back(r * std::cos(around), r * std::sin(around), z);
    }
    return all;
}

struct Errors {
    double mean = 0.0;
    double most = 0.0;
};

Errors errors(const std::vector<double>& all) {
    Errors found;
    for (const double error : all) {
        found.mean += std::abs(error) / static_cast<double>(all.size());
        found.most = std::max(found.most, std::abs(error));
    }
    return found;
}

Errors errors_of_ball(double radius) {
    const SmoothBorder border(
        box, [&](const glm::ivec3& voxel) { return glm::distance(glm::dvec3(voxel), centre) <= radius; });
    std::vector<double> off;
    for (const glm::dvec3& direction : directions())
        off.push_back(reaches(border, direction, radius + 3.0) - radius);
    return errors(off);
}

TEST(SmoothBorder, OfABallIsASphere) {
    for (const double radius : {6.3, 12.7}) {
        const Errors off = errors_of_ball(radius);
        EXPECT_LT(off.mean, 0.1) << radius;
        EXPECT_LT(off.most, 0.4) << radius;
    }
    EXPECT_LT(errors_of_ball(2.3).mean, 0.25) << "a small one stays as large as its voxels";
}

TEST(SmoothBorder, OfASlantIsAPlaneWithoutSteps) {
    for (const double slope : {0.1, 0.3, 0.7}) {
        const auto height = [&](double x, double y) { return 20.3 + slope * (x - 20.0) + 0.05 * (y - 20.0); };
        const SmoothBorder border(
            box, [&](const glm::ivec3& voxel) { return voxel.z < height(voxel.x, voxel.y); });
        std::vector<double> off;
        for (double x = 10.0; x < 30.0; x += 0.37) {
            double top = 0.0;
            for (double z = 8.0; z < 34.0; z += 0.01)
                if (border.holds({x, 21.7, z})) top = z;
            off.push_back(top - height(x, 21.7));
        }
        EXPECT_LT(errors(off).mean, 0.14) << slope;
        EXPECT_LT(errors(off).most, 0.3) << slope;
    }
}

TEST(SmoothBorder, KeepsEachVoxelOnItsSideAndSoASheetOfOne) {
    const auto is_in = [](const glm::ivec3& voxel) { return voxel.z == 20 + voxel.x / 16; };
    const SmoothBorder border(box, is_in);
    glm::ivec3 voxel;
    for (voxel.z = 15; voxel.z < 26; ++voxel.z)
        for (voxel.x = 0; voxel.x <= 40; ++voxel.x) {
            voxel.y = 17;
            ASSERT_EQ(border.holds(glm::dvec3(voxel)), is_in(voxel)) << voxel.x << ' ' << voxel.z;
        }
}

TEST(SmoothBorder, IsFarOffWhereThereIsNone) {
    EXPECT_EQ(SmoothBorder(box, [](const glm::ivec3&) { return false; }).distance({5, 5, 5}),
              SmoothBorder::reach_voxels);
    EXPECT_EQ(SmoothBorder(box, [](const glm::ivec3&) { return true; }).distance({5, 5, 5}),
              -SmoothBorder::reach_voxels);
}

/// Sections of a cube of bone 9.6 mm wide, voxels of 0.2 mm.
class SectionBorders : public ::testing::Test {
  protected:
    static constexpr int size_px = 480;
    static constexpr double half_width_mm = 4.0;
    static constexpr double spacing_mm = 0.2;

    /// Seen from the front. Where a pixel is, mm from the middle: to the right, and up.
    RgbPicture section(const Bone& bone, const std::vector<Tissue>& tissues,
                       const SectionMarks& marks) const {
        return picture_of(
            bone, tissues,
            {.direction = {0, 1, 0}, .up = {0, 0, 1}, .half_width_mm = half_width_mm, .is_section = true},
            size_px, marks);
    }
    static double mm_of(int pixel) { return half_width_mm * ((2.0 * pixel + 1.0) / size_px - 1.0); }
    static std::size_t place(int row, int column) {
        return static_cast<std::size_t>(3 * (size_px * row + column));
    }
};

TEST_F(SectionBorders, DrawAStructuresBallAsACircle) {
    const Bone bone =
        testing::labelled_cube(3, spacing_mm, [](const glm::dvec3&) { return std::uint8_t{1}; });
    constexpr double radius_mm = 1.47;
    const RgbPicture picture = section(
        bone, {{.label = 2, .name = "nerve", .colour_rgb = {0, 255, 0}, .is_protected = true}},
        {.structures =
             std::vector<Structure>{{0, testing::ball_mask(bone.grid(), glm::dvec3(0.0), radius_mm)}}});
    // A pixel's share of the structure, by its green, is what the circle covers of it but for a fraction of a
    // voxel.
    double area_mm2 = 0.0;
    double most_off_mm = 0.0;
    for (int row = 0; row < size_px; ++row)
        for (int column = 0; column < size_px; ++column) {
            const std::size_t at = place(row, column);
            const bool is_drawn = picture.rgb[at] < picture.rgb[at + 1] / 2;
            const double from_middle_mm = std::hypot(mm_of(row), mm_of(column));
            if (is_drawn) area_mm2 += std::pow(2.0 * half_width_mm / size_px, 2);
            if (is_drawn != (from_middle_mm < radius_mm))
                most_off_mm = std::max(most_off_mm, std::abs(from_middle_mm - radius_mm));
        }
    EXPECT_LT(most_off_mm, 0.4 * spacing_mm);
    EXPECT_NEAR(std::sqrt(area_mm2 / std::numbers::pi), radius_mm, 0.15 * spacing_mm);
}

/// A tissue that borders on air, whose voxels are also a structure's, ends where bone ends: on a line, though
/// voxels are filled in part.
TEST_F(SectionBorders, DrawTheOuterBorderOfAStructureThatIsBoneWhereBoneEnds) {
    const Grid grid{.size_voxels = {48, 48, 48}, .spacing_mm = spacing_mm, .origin_mm = glm::dvec3(-4.7)};
    constexpr double slope = 0.13;
    const auto depth_mm = [](const glm::dvec3& at) {
        return (0.06 + slope * at.x - at.z) / std::hypot(1.0, slope);
    };
    const Bone bone = made_bone(grid, depth_mm, [](const glm::dvec3&) { return std::uint8_t{2}; });
    std::vector<StructureBrick> bricks;
    for (BrickIndex number = 0; number < 27; ++number) {
        StructureBrick brick{.brick = number};
        const glm::ivec3 first = brick_edge_voxels * brick_position(size_in_bricks(grid), number);
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
            if (bone.fraction_at(first + voxel_in_brick(offset)) > 0) brick.voxels.set(offset);
        if (brick.voxels.any()) bricks.push_back(brick);
    }
    const RgbPicture picture =
        section(bone, {{.label = 2, .name = "sinus", .colour_rgb = {0, 0, 255}, .is_protected = true}},
                {.structures = std::vector<Structure>{{0, StructureMask(grid, std::move(bricks))}}});
    std::vector<double> off_voxels;
    for (int column = 60; column < size_px - 60; ++column) {
        int row = 0;
        while (row < size_px && picture.rgb[place(row, column)] > 127) ++row;
        off_voxels.push_back((-mm_of(row) - (0.06 + slope * mm_of(column))) / spacing_mm);
    }
    EXPECT_LT(errors(off_voxels).mean, 0.08);
    EXPECT_LT(errors(off_voxels).most, 0.2);
}

/// A structure of bone that was milled is a cavity; a soft one beside bone is drawn whole.
TEST_F(SectionBorders, DrawNothingOfAStructureWhereItWasMilled) {
    constexpr double radius_mm = 1.47, milled_mm = 0.8;
    Bone bone = testing::labelled_cube(3, spacing_mm, [](const glm::dvec3& at) {
        return static_cast<std::uint8_t>(glm::length(at) < radius_mm ? 2 : 1);
    });
    for (std::int32_t slot = 0; slot < static_cast<std::int32_t>(bone.stored_bricks()); ++slot) {
        const glm::ivec3 first =
            brick_edge_voxels * brick_position(bone.content().size_bricks,
                                               bone.content().brick_of_slot[static_cast<std::size_t>(slot)]);
        const auto fractions = bone.fractions(slot);
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
            if (glm::length(centre_of_voxel_mm(bone.grid(), first + voxel_in_brick(offset))) < milled_mm)
                fractions[offset] = 0;
    }
    const std::vector<Tissue> tissues{
        {.label = 1, .name = "bone", .colour_rgb = {200, 200, 200}},
        {.label = 2, .name = "pulp", .colour_rgb = {255, 0, 0}, .is_protected = true},
        {.label = 3, .name = "nerve", .colour_rgb = {255, 0, 0}, .is_protected = true}};
    const StructureMask ball = testing::ball_mask(bone.grid(), glm::dvec3(0.0), radius_mm);
    const int middle = size_px / 2;
    const auto red_at = [&](std::size_t tissue, double right_mm) {
        const RgbPicture picture =
            section(bone, tissues, {.structures = std::vector<Structure>{{tissue, ball}}});
        return int{picture.rgb[place(middle, middle + static_cast<int>(right_mm / half_width_mm * middle))]};
    };
    const int flat = red_at(1, 1.1);
    EXPECT_GT(flat, 220) << "what is left of it is cut flat";
    EXPECT_LT(red_at(1, 0.0), flat - 20) << "its milled middle is a cavity, in the light";
    EXPECT_EQ(red_at(2, 0.0), flat) << "nothing of a soft one was milled";
}

TEST_F(SectionBorders, DrawTheBorderOfTwoTissuesAsALine) {
    constexpr double slope = 0.2;
    const Bone bone = testing::labelled_cube(3, spacing_mm, [](const glm::dvec3& at) {
        return static_cast<std::uint8_t>(at.z < 0.07 + slope * at.x ? 1 : 2);
    });
    const RgbPicture picture = section(bone,
                                       {{.label = 1, .name = "a", .colour_rgb = {0, 0, 0}},
                                        {.label = 2, .name = "b", .colour_rgb = {250, 250, 250}}},
                                       {});
    std::vector<double> off_voxels;
    for (int column = 60; column < size_px - 60; ++column) {
        int row = 0;
        while (row < size_px && picture.rgb[place(row, column)] > 115) ++row;
        off_voxels.push_back((-mm_of(row) - (0.07 + slope * mm_of(column))) / spacing_mm);
    }
    EXPECT_LT(errors(off_voxels).mean, 0.15);
    EXPECT_LT(errors(off_voxels).most, 0.35);
}

/// A wall that was milled aslant through voxels, with a border that crosses it aslant.
TEST_F(SectionBorders, OnAMilledWallAreALine) {
    constexpr double slope = 0.2, slant = 0.15;
    Bone bone = testing::labelled_cube(3, spacing_mm, [](const glm::dvec3& at) {
        return static_cast<std::uint8_t>(at.z < 0.07 + slope * at.x + 0.3 * at.y ? 1 : 2);
    });
    const glm::ivec3 bricks = size_in_bricks(bone.grid());
    for (BrickIndex number = 0; number < 27; ++number) {
        const glm::ivec3 first = brick_edge_voxels * brick_position(bricks, number);
        const auto fractions = bone.fractions(bone.slot(number));
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
            const glm::dvec3 at = centre_of_voxel_mm(bone.grid(), first + voxel_in_brick(offset));
            const double left = 0.5 + (at.y - slant * at.x) / spacing_mm;
            fractions[offset] = static_cast<std::uint8_t>(255.0 * std::clamp(left, 0.0, 1.0));
        }
    }
    const RgbPicture picture =
        picture_of(bone,
                   {std::vector<Tissue>{{.label = 1, .name = "a", .colour_rgb = {0, 0, 0}},
                                        {.label = 2, .name = "b", .colour_rgb = {250, 250, 250}}}},
                   {.direction = {0, 1, 0}, .up = {0, 0, 1}, .half_width_mm = half_width_mm}, size_px);
    std::vector<double> off_voxels;
    for (int column = 100; column < size_px - 100; ++column) {
        int bright = 0;
        for (int row = 0; row < size_px; ++row)
            bright = std::max(bright, int{picture.rgb[place(row, column)]});
        int row = 60;
        while (row < size_px && picture.rgb[place(row, column)] > bright / 2) ++row;
        const double x_mm = mm_of(column);
        off_voxels.push_back((-mm_of(row) - (0.07 + slope * x_mm + 0.3 * slant * x_mm)) / spacing_mm);
    }
    double mean = 0.0;
    for (const double off : off_voxels) mean += off / static_cast<double>(off_voxels.size());
    for (double& off : off_voxels) off -= mean;
    EXPECT_LT(std::abs(mean), 0.4);
    EXPECT_LT(errors(off_voxels).mean, 0.15);
    EXPECT_LT(errors(off_voxels).most, 0.4);
}

TEST_F(SectionBorders, OutlineARegionOfVoxels) {
    const Bone bone =
        testing::labelled_cube(3, spacing_mm, [](const glm::dvec3&) { return std::uint8_t{1}; });
    constexpr double radius_mm = 1.47;
    const RgbPicture picture =
        section(bone, {}, {.is_outlined_voxel = [&](const glm::ivec3& voxel) {
                    return glm::length(centre_of_voxel_mm(bone.grid(), voxel)) < radius_mm;
                }});
    int count = 0;
    for (int row = 0; row < size_px; ++row)
        for (int column = 0; column < size_px; ++column) {
            const std::size_t at = place(row, column);
            if (picture.rgb[at] != 0 || picture.rgb[at + 2] != 200) continue;
            ++count;
            EXPECT_NEAR(std::hypot(mm_of(row), mm_of(column)), radius_mm, 0.4 * spacing_mm);
        }
    EXPECT_GT(count, 400);
}

}  // namespace
}  // namespace osteomill
