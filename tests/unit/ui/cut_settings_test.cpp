#include "render_client/ui/view/cut_settings.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace osteomill::cut_settings_test {
namespace {

class Cuts : public ::testing::Test {
  protected:
    Cuts() { cuts.set_bounds({0.0, 0.0, 0.0}, {10.0, 20.0, 30.0}); }

    bool takes_away(const glm::dvec3& point) const {
        for (const CutPlane& plane : cuts.planes())
            if (glm::dot(plane.normal, point) > plane.offset_mm) return true;
        return false;
    }

    CutSettings cuts;
    /// In front of the patient, to the viewer's right, above.
    const Camera camera{.azimuth_rad = 0.4, .elevation_rad = 0.5};
    const glm::dvec3 middle{5.0, 10.0, 15.0};
};

TEST_F(Cuts, TakeAwayTheHalfNearerToTheEyeThenTheOtherThenNothing) {
    EXPECT_FALSE(cuts.any());
    cuts.step(0, camera);
    EXPECT_TRUE(takes_away({9.0, 10.0, 15.0}));
    EXPECT_FALSE(takes_away({1.0, 10.0, 15.0}));
    cuts.step(0, camera);
    EXPECT_FALSE(takes_away({9.0, 10.0, 15.0}));
    EXPECT_TRUE(takes_away({1.0, 10.0, 15.0}));
    cuts.step(0, camera);
    EXPECT_FALSE(cuts.any());
}

TEST_F(Cuts, AcrossTheViewTakesAwayWhatIsInFrontOfTheMiddle) {
    cuts.step(CutSettings::across_view, camera);
    EXPECT_TRUE(takes_away(middle - 0.1 * camera.forward()));
    EXPECT_FALSE(takes_away(middle + 0.1 * camera.forward()));
    cuts.step(CutSettings::across_view, camera);
    EXPECT_TRUE(cuts.planes().empty());
}

TEST_F(Cuts, MoveWithinTheBone) {
    cuts.step(1, camera);
    cuts.move_last(4.0);  // the front is nearer to the eye: outwards is forwards
    EXPECT_TRUE(takes_away({5.0, 5.9, 15.0}));
    EXPECT_FALSE(takes_away({5.0, 6.1, 15.0}));
    cuts.move_last(100.0);
    EXPECT_FALSE(takes_away({5.0, 0.1, 15.0}));
    cuts.switch_off(1);
    cuts.move_last(-100.0);
    EXPECT_DOUBLE_EQ(cuts[1].position_mm, 10.0) << "a cut that is off stays";
}

TEST_F(Cuts, SetBeforeTheBoneIsKnownAreConfinedByIt) {
    CutSettings early;
    early.set(2, {0.0, 0.0, -1.0}, 12.0);
    early.set(0, {1.0, 0.0, 0.0}, 80.0);
    early.set_bounds({0.0, 0.0, 0.0}, {10.0, 20.0, 30.0});
    ASSERT_EQ(early.planes().size(), 2U);
    EXPECT_DOUBLE_EQ(early.planes()[0].offset_mm, 10.0);
    EXPECT_DOUBLE_EQ(early.planes()[1].offset_mm, -3.0) << "what lies below z = 3 is gone";
}

TEST_F(Cuts, TurnOverInPlace) {
    cuts.step(2, camera);
    cuts.move_to(2, 5.0);
    EXPECT_TRUE(takes_away({5.0, 10.0, 21.0}));
    cuts.turn_over(2);
    EXPECT_FALSE(takes_away({5.0, 10.0, 21.0}));
    EXPECT_TRUE(takes_away({5.0, 10.0, 19.0}));
}

TEST_F(Cuts, AreNoMoreThanARendererHeeds) {
    for (std::size_t cut = 0; cut < CutSettings::count; ++cut) cuts.step(cut, camera);
    EXPECT_EQ(cuts.planes().size(), most_cut_planes);
}

}  // namespace
}  // namespace osteomill::cut_settings_test
