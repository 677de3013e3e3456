#include "studies/loads/pressed_burr.h"

#include <gtest/gtest.h>

namespace osteomill::study {
namespace {

const Burr burr{
    .diameter_mm = 1.5, .spindle_rev_per_s = 40'000.0 / 60.0, .edge_coefficients_n_per_mm = {0.3, 0.3, 0.0}};

TEST(PressedBurr, RemovesMoreWithMoreLoadAndLessOfWhatIsHarder) {
    const auto rate = [](double load_n, double relative) {
        return press({.burr = burr,
                      .material = {.relative_stiffness = relative, .relative_edge = relative},
                      .load_n = load_n,
                      .length_mm = 3.0})
            .removal_mm3_per_s;
    };
    const double soft = rate(0.34, 1.0);
    EXPECT_GT(soft, 0.0);
    EXPECT_GT(rate(0.5, 1.0), 1.2 * soft);
    EXPECT_LT(rate(0.34, 2.0), 0.5 * soft);
}

TEST(PressedBurr, SinksUnderALoadThatEdgesDoNotHold) {
    Burr published = burr;
    published.edge_coefficients_n_per_mm = glm::dvec3(0.0);
    const PressedResult sinks = press({.burr = published, .load_n = 1.05});
    EXPECT_TRUE(sinks.sinks);
    const PressedResult held =
        press({.burr = burr, .material = {.relative_stiffness = 3.0, .relative_edge = 3.0}, .load_n = 1.05});
    EXPECT_FALSE(held.sinks);
    EXPECT_LT(held.depth_mm, 0.4);
}

}  // namespace
}  // namespace osteomill::study
