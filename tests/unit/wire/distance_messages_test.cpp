#include "common/wire/distance_messages.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace osteomill {
namespace {

TEST(StructureDistances, ComeAsTheyWereSent) {
    const StructureDistance near{.tissue = 1,
                                 .distance_mm = -0.25,
                                 .touches = true,
                                 .touches_so_far = 3,
                                 .first_touch_s = 1.5,
                                 .touched_s = 0.75,
                                 .removed_mm3 = 0.125,
                                 .entered_mm3 = 2.0};
    const StructureDistance far{.tissue = 2, .touches_so_far = 1};
    v2::StateFrame frame;
    *frame.add_distances() = to_message(near);
    *frame.add_distances() = to_message(far);
    const auto read = structure_distances_from(frame.distances(), 3);
    EXPECT_EQ(std::get<0>(read), (std::vector{near, far}));
    EXPECT_EQ(nearest_structure(std::get<0>(read)), &std::get<0>(read)[0]);
    EXPECT_EQ(nearest_structure({}), nullptr);
}

TEST(StructureDistances, RefuseWhatCannotBe) {
    const auto refused = [](auto&& change) {
        v2::StateFrame frame;
        change(*frame.add_distances(), frame);
        const auto read = structure_distances_from(frame.distances(), 2);
        const auto* error = std::get_if<WireError>(&read);
        return error != nullptr ? error->line : std::string();
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(refused([](auto&, auto&) {}), "");
    EXPECT_EQ(refused([](auto& d, auto&) { d.set_tissue(2); }),
              "a distance is of tissue 2, not one of the scene's 2");
    EXPECT_EQ(refused([](auto&, auto& frame) { frame.add_distances(); }), "two distances are of tissue 0");
    for (const double bad : {nan, std::numeric_limits<double>::infinity()}) {
        EXPECT_NE(refused([&](auto& d, auto&) { d.set_distance_mm(bad); }), "");
        EXPECT_NE(refused([&](auto& d, auto&) { d.set_first_touch_s(bad); }), "");
        EXPECT_NE(refused([&](auto& d, auto&) { d.set_touched_s(bad); }), "");
    }
    EXPECT_NE(refused([](auto& d, auto&) { d.set_removed_mm3(-1.0); }), "");
    EXPECT_NE(refused([](auto& d, auto&) { d.set_entered_mm3(-1.0); }), "");
}

}  // namespace
}  // namespace osteomill
