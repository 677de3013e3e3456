#include "render_client/volume/passes/tile_mask.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <random>

#include "render_client/volume/camera.h"

namespace osteomill::tile_mask_test {
namespace {

const glm::ivec2 size_px(200, 150);  // no multiple of a tile either way

TEST(TileMask, MarksTheTilesThatABoxTouchesAndNoOther) {
    TileMask mask(size_px);
    mask.mark({{31, 16}, {2, 1}});
    EXPECT_EQ(mask.tiles().size(), 2u);
    EXPECT_TRUE(mask.contains({31, 16}));
    EXPECT_TRUE(mask.contains({32, 31}));
    EXPECT_FALSE(mask.contains({48, 16}));
    EXPECT_FALSE(mask.contains({31, 15}));
}

TEST(TileMask, IgnoresWhatLiesOutsideThePicture) {
    TileMask mask(size_px);
    mask.mark({{-50, -50}, {40, 500}});
    mask.mark({{200, 0}, {5, 5}});
    mask.mark({{10, 10}, {0, 5}});
    mask.mark_hull(std::array{glm::dvec2(-1e12, -40.0), glm::dvec2(-5.0, 1e12)}, 1.0);
    EXPECT_FALSE(mask.any());
    mask.mark({{-50, -50}, {500, 500}});
    EXPECT_EQ(mask.pixels(), static_cast<std::int64_t>(size_px.x) * size_px.y);
}

TEST(TileMask, JoinsUnionsAndDifferences) {
    TileMask left(size_px), right(size_px);
    left.mark({{0, 0}, {64, 16}});
    right.mark({{32, 0}, {64, 16}});
    EXPECT_EQ((TileMask(left) |= right).tiles().size(), 6u);
    EXPECT_EQ((TileMask(left) &= right).tiles().size(), 2u);
    EXPECT_EQ((TileMask(left) -= right).tiles().size(), 2u);
    left.clear();
    EXPECT_FALSE(left.any());
}

TEST(TileMask, SplitsIntoRectanglesThatCoverEachMarkedPixelOnce) {
    std::mt19937 random(3);
    for (int round = 0; round < 20; ++round) {
        TileMask mask(size_px);
        for (int box = 0; box < 1 + round; ++box)
            mask.mark({{static_cast<int>(random() % 200), static_cast<int>(random() % 150)},
                       {static_cast<int>(random() % 60), static_cast<int>(random() % 60)}});
        TileMask again(size_px);
        std::int64_t pixels = 0;
        for (const PixelBox& box : mask.rectangles()) {
            again.mark(box);
            pixels += box.count();
        }
        EXPECT_EQ(again, mask);
        EXPECT_EQ(pixels, mask.pixels());
    }
}

TEST(TileMask, JoinsRowsOfEqualExtent) {
    TileMask mask(size_px);
    mask.mark({{40, 20}, {100, 90}});
    mask.mark({{160, 100}, {1, 1}});
    EXPECT_EQ(mask.rectangles().size(), 2u);
    mask.mark_all();
    EXPECT_EQ(mask.rectangles(), std::vector<PixelBox>{(PixelBox{{0, 0}, size_px})});
}

// Each point of a box, wherever it is seen, lies in a marked tile; and the tiles hug the box's outline.
TEST(TileMask, MarksWhereABoxCanBeSeen) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-6.0, 6.0), edge(0.1, 3.0), part(0.0, 1.0);
    Camera camera = camera_on({0.0, 0.0, 0.0}, 8.0);
    for (int round = 0; round < 200; ++round) {
        camera.azimuth_rad = 0.1 * round;
        const glm::dvec3 low(place(random), place(random), place(random));
        const glm::dvec3 high = low + glm::dvec3(edge(random), edge(random), edge(random));
        TileMask mask(size_px);
        mark_box(mask, low, high, camera.projection(size_px) * camera.view());
        for (int sample = 0; sample < 50; ++sample) {
            const glm::dvec3 point =
                low + (high - low) * glm::dvec3(part(random), part(random), part(random));
            const glm::dvec2 px = pixel_of(camera, point, size_px);
            const glm::ivec2 pixel(glm::floor(glm::dvec2(px.x, size_px.y - px.y)));
            const bool inside = pixel.x >= 0 && pixel.y >= 0 && pixel.x < size_px.x && pixel.y < size_px.y;
            if (inside) {
                EXPECT_TRUE(mask.contains(pixel));
            }
        }
    }
}

TEST(TileMask, LeavesOutTheCornersOfASlantedBar) {
    TileMask mask(size_px);
    mask.mark_hull(std::array{glm::dvec2(10, 10), glm::dvec2(20, 4), glm::dvec2(180, 140)}, 0.0);
    EXPECT_TRUE(mask.contains({100, 77}));
    EXPECT_FALSE(mask.contains({20, 130}));
    EXPECT_FALSE(mask.contains({180, 20}));
    EXPECT_LT(mask.pixels(), size_px.x * size_px.y / 4);
}

TEST(TileMask, MarksEverythingForABoxThatReachesBehindTheEye) {
    const Camera camera = camera_on({0.0, 0.0, 0.0}, 8.0);
    TileMask mask(size_px);
    mark_box(mask, glm::dvec3(-100.0), glm::dvec3(100.0), camera.projection(size_px) * camera.view());
    EXPECT_EQ(mask.pixels(), static_cast<std::int64_t>(size_px.x) * size_px.y);
}

}  // namespace
}  // namespace osteomill::tile_mask_test
