#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "analysis/report/picture_overlay.h"
#include "analysis/report/session_pictures.h"
#include "analysis/report/session_trace.h"
#include "tests/support/ball_structure.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/written_session.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

Bone cube() {
    return testing::labelled_cube(2, 0.2, [](const glm::dvec3&) { return std::uint8_t{1}; });
}

TEST(PictureOverlay, NamesDirectionsAsRadiologistsDo) {
    EXPECT_EQ(direction_letters({1, 0, 0}), "L");
    EXPECT_EQ(direction_letters({-1, 0, 0}), "R");
    EXPECT_EQ(direction_letters({0, 1, 0}), "P");
    EXPECT_EQ(direction_letters({0, -1, 0}), "A");
    EXPECT_EQ(direction_letters({0, 0, 1}), "S");
    EXPECT_EQ(direction_letters({0, 0, -1}), "I");
    EXPECT_EQ(direction_letters({-0.5, -0.8, 0.3}), "AR");
}

TEST(PictureOverlay, HasTheRightAtTheLeftSeenFromTheFront) {
    const std::string svg = picture_overlay({.direction = {0, 1, 0}, .up = {0, 0, 1}, .half_width_mm = 10.0});
    EXPECT_THAT(svg, HasSubstr("<text x='10' y='155'>R</text>"));
    EXPECT_THAT(svg, HasSubstr("<text x='290' y='155'>L</text>"));
    EXPECT_THAT(svg, HasSubstr("<text x='150' y='15'>S</text>"));
    EXPECT_THAT(svg, HasSubstr("h75.00v-6")) << "5 mm of a picture 20 mm and 300 units wide";
    EXPECT_THAT(svg, HasSubstr(">5 mm</text>"));
}

TEST(PictureOverlay, DrawsTheBurrWhereItIsAndAsLargeAsItIs) {
    const std::string svg = picture_overlay({.direction = {0, 1, 0}, .up = {0, 0, 1}, .half_width_mm = 10.0},
                                            SeenBurr{{2, 7, -4}, {0, 0, 1}, 3.0});
    EXPECT_THAT(svg, HasSubstr("translate(180.00 210.00)' r='22.50'"));
}

TEST(SurfaceNormal, IsThePlanesOwn) {
    // Below the cube's top at z = 3.2, in from its other faces.
    const auto square = normal_about(cube(), {0, 0, 2.9}, 1.5);
    ASSERT_TRUE(square);
    EXPECT_GT(glm::dot(*square, glm::dvec3(0, 0, 1)), std::cos(glm::radians(1.5)));
    const auto from_side = normal_about(cube(), {-3.4, 0.4, -0.3}, 1.0);
    ASSERT_TRUE(from_side);
    EXPECT_GT(glm::dot(*from_side, glm::dvec3(-1, 0, 0)), std::cos(glm::radians(1.5)));
    EXPECT_FALSE(normal_about(cube(), {0, 0, 0}, 1.0)) << "bone on every side";
    EXPECT_FALSE(normal_about(cube(), {0, 0, 30.0}, 1.0)) << "bone on none";
}

class Approached : public ::testing::Test {
  protected:
    /// A nerve of 1 mm in the cube's middle; the burr of 1 mm goes by at x = 2.2.
    SessionTrace trace() {
        const auto file = folder_ / "a.pcap";
        const Bone bone = cube();
        testing::WrittenSession written(file,
                                        {.scene_name = "cube",
                                         .burrs = {Burr{.diameter_mm = 1.0}},
                                         .tissues = {{.label = 2, .name = "nerve", .is_protected = true}},
                                         .plan = Plan{.region = SphereRegion{{1.0, -1.0, 0.5}, 1.2}}},
                                        bone, {{0, testing::ball_mask(bone.grid(), {0, 0, 0}, 1.0)}});
        for (int i = 0; i <= 8; ++i)
            written.frame({.time_s = 0.1 * i, .burr_position_mm = {2.2, 0.5 * (i - 5), 0.0}});
        written.finish();
        return read_trace(file, [](double) {});
    }

    testing::TemporaryFolder folder_;
};

TEST_F(Approached, IsWhereTheBurrWasNearest) {
    const SessionTrace read = trace();
    const auto approach = nearest_approach(read);
    ASSERT_TRUE(approach);
    EXPECT_EQ(approach->structure, "nerve");
    EXPECT_NEAR(approach->distance_mm, 2.2 - 1.0 - 0.5, 0.1);
    EXPECT_NEAR(approach->sample->time_s, 0.5, 1e-9);
    EXPECT_NEAR(glm::length(approach->structure_mm - glm::dvec3(1.0, 0, 0)), 0.0, 0.2);
    // The way from burr to nerve, along x, lies in the section, and both are seen.
    const NamedView view = view_of(*approach, 1.0);
    EXPECT_TRUE(view.view.is_section);
    EXPECT_EQ(view.view.direction.x, 0.0);
    EXPECT_EQ(view.view.centre_mm, approach->sample->burr_mm);
    EXPECT_GT(view.view.half_width_mm, 1.2);
    EXPECT_THAT(view.title, HasSubstr(" mm from the nerve, at 0.5 s, section, from the front"));
}

TEST_F(Approached, ShowsTheMiddleOfThePlan) {
    const SessionTrace read = trace();
    const PlannedRegion region(read.at_start, read.session);
    const auto target = view_of_target(read, &region);
    ASSERT_TRUE(target);
    EXPECT_NEAR(glm::length(target->view.centre_mm - glm::dvec3(1.0, -1.0, 0.5)), 0.0, 0.2);
    EXPECT_THAT(target->title, HasSubstr("Through the target"));
    EXPECT_TRUE(region.holds(glm::dvec3(1.0, -1.0, 1.6)));
    EXPECT_FALSE(region.holds(glm::dvec3(1.0, -1.0, 1.8)));
}

TEST_F(Approached, DrawsStructureAndPlanIntoTheSection) {
    const SessionTrace read = trace();
    const std::vector<Tissue> tissues{
        {.label = 2, .name = "nerve", .colour_rgb = {250, 10, 20}, .is_protected = true}};
    const BoneView view{.direction = {0, 1, 0}, .up = {0, 0, 1}, .half_width_mm = 3.0, .is_section = true};
    const RgbPicture picture = picture_of(read.at_end, tissues, view, 30,
                                          {.structures = read.structure_places,
                                           .is_outlined = [](const glm::dvec3& at) { return at.x > 1.5; }});
    const auto red_of = [&](int row, int column) {
        return picture.rgb[static_cast<std::size_t>(3 * (30 * row + column))];
    };
    EXPECT_EQ(red_of(15, 15), 250) << "the nerve's, in the middle";
    EXPECT_LT(red_of(15, 9), 240) << "bone, 1.1 mm beside it";
    EXPECT_GT(red_of(15, 9), 100);
    // 2.5 of 3 mm to the right: pixel 22.5. The border's colour differs from that of its inside.
    EXPECT_EQ(red_of(15, 23), 0);
    EXPECT_GT(red_of(15, 27), 100);
}

}  // namespace
}  // namespace osteomill
