#include "render_client/volume/ct_slice.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "studies/render/made_bone.h"

namespace osteomill {
namespace {

TEST(CtSlice, PixelAndPositionAreEachOthersReverse) {
    for (const SlicePlane plane : {SlicePlane::axial, SlicePlane::coronal, SlicePlane::sagittal}) {
        const SliceView view{.plane = plane, .centre_mm = {1.0, 2.0, 3.0}, .mm_per_px = 0.25, .edge_px = 80};
        EXPECT_EQ(view.position_mm({40.0, 40.0}), view.centre_mm);
        const glm::dvec2 pixel(13.0, 61.0);
        EXPECT_LT(glm::distance(view.pixel(view.position_mm(pixel)), pixel), 1e-9);
        EXPECT_NEAR(glm::dot(view.position_mm(pixel) - view.centre_mm, view.across()), 0.0, 1e-12);
    }
}

TEST(CtSlice, HasThePatientsSidesWhereARadiologistExpectsThem) {
    const auto right_of = [](SlicePlane plane) { return SliceView{.plane = plane}.right(); };
    const auto down_of = [](SlicePlane plane) { return SliceView{.plane = plane}.down(); };
    EXPECT_EQ(right_of(SlicePlane::axial), glm::dvec3(1, 0, 0)) << "patient left is right in the picture";
    EXPECT_EQ(down_of(SlicePlane::axial), glm::dvec3(0, 1, 0)) << "the back is below";
    EXPECT_EQ(right_of(SlicePlane::coronal), glm::dvec3(1, 0, 0));
    EXPECT_EQ(down_of(SlicePlane::coronal), glm::dvec3(0, 0, -1)) << "the feet are below";
    EXPECT_EQ(right_of(SlicePlane::sagittal), glm::dvec3(0, 1, 0));
    EXPECT_EQ(edge_letters(SlicePlane::axial), (std::array<char, 4>{'R', 'L', 'A', 'P'}));
    EXPECT_EQ(edge_letters(SlicePlane::sagittal), (std::array<char, 4>{'A', 'P', 'S', 'I'}));
}

TEST(CtSlice, ShowsHuInTheWindowAndTheBorderOfTheBone) {
    const Grid grid{.size_voxels = {60, 60, 60}, .spacing_mm = 0.2, .origin_mm = glm::dvec3(-5.9)};
    const Bone bone = made_bone(grid, [](const glm::dvec3& p) { return 4.0 - glm::length(p); });
    CtVolume ct{.grid = grid, .hu = std::vector<std::int16_t>(60 * 60 * 60, 300)};
    const SliceView view{
        .plane = SlicePlane::coronal, .centre_mm = {0, 0, 0}, .mm_per_px = 0.1, .edge_px = 100};
    const HuWindow window{.level_hu = 300.0, .window_hu = 1000.0};
    const auto pixels = slice_picture(ct, &bone, {}, view, window);
    ASSERT_EQ(pixels.size(), 4U * 100U * 100U);
    const auto at = [&](int x, int y) { return &pixels[4 * static_cast<std::size_t>(x + 100 * y)]; };
    EXPECT_EQ(at(50, 50)[0], 128);
    EXPECT_EQ(at(2, 2)[0], 128);
    int orange = 0;
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x) {
            if (at(x, y)[0] == at(x, y)[2]) continue;
            ++orange;
            EXPECT_NEAR(glm::length(view.position_mm({x + 0.5, y + 0.5})), 4.0, 0.25);
        }
    EXPECT_GT(orange, 150) << "all the way round a circle of 80 pixels";
    // A nerve in the bone: a cube, whose section is a square.
    StructureMask nerve(grid, {{brick_index(size_in_bricks(grid), {2, 1, 1}), VoxelMask().set_all()}});
    const std::vector<SliceTissue> tissues{{.label = 1, .colour_rgb = {10, 250, 20}, .mask = nerve}};
    const auto with_nerve = slice_picture(ct, &bone, tissues, view, window);
    int green = 0;
    for (std::size_t i = 0; i < with_nerve.size(); i += 4)
        if (with_nerve[i] == 10 && with_nerve[i + 1] == 250) ++green;
    EXPECT_NEAR(green, 4 * 32, 6) << "3.2 mm square, 0.1 mm a pixel";
    EXPECT_EQ(window.grey(-500.0), 0);
    EXPECT_EQ(window.grey(1000.0), 255);
}

}  // namespace
}  // namespace osteomill
