#include "analysis/calibration/calibration_report.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "common/scene/scene_file.h"
#include "tests/unit/studies/calibration/synthetic_runs.h"

namespace osteomill::study {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

MaterialCalibration calibration_of(const Coefficients& coefficients, double noise) {
    MaterialCalibration c{.material = "bovine \"cortical\""};
    for (const RunSetting& setting : twelve_settings())
        c.runs.push_back({.name = std::to_string(c.runs.size() + 1),
                          .material = c.material,
                          .setting = setting,
                          .spread_n = glm::dvec3(0.05)});
    c.input = fit_input(c.runs);
    c.input.force_n = c.input.regressors * coefficients;
    std::mt19937_64 random(7);
    c.input = with_noise(c.input, noise, random);
    for (std::size_t i = 0; i < c.runs.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            c.runs[i].force_n[axis] = c.input.force_n(3 * static_cast<Eigen::Index>(i) + axis);
    c.fit = fit_coefficients(c.input);
    c.predicted_n = predictions_without_each_run(c.input);
    return c;
}

TEST(CalibrationReport, GivesEachCoefficientWithItsInterval) {
    const auto json = json_of(calibration_of(known_coefficients(), 1.0));
    ASSERT_EQ(json.at("coefficients").size(), 6u);
    const auto& k_t = json.at("coefficients").at(0);
    EXPECT_EQ(k_t.at("name"), "K_t");
    EXPECT_LT(k_t.at("interval_95").at(0), 230.0);
    EXPECT_GT(k_t.at("interval_95").at(1), 230.0);
    EXPECT_NEAR(json.at("reduced_chi_squared"), 1.0, 0.6);
    EXPECT_NEAR(json.at("leave_one_run_out").at("rms_in_spreads"), 1.1, 0.5);
    EXPECT_EQ(json.at("leave_one_run_out").at("runs"), 12);
    EXPECT_THAT(json.at("warnings"), IsEmpty());
}

TEST(CalibrationReport, WarnsOfSignsThatAreWrongAndOfScatter) {
    Coefficients turned = known_coefficients();
    turned(0) *= -1.0;
    EXPECT_THAT(warnings_of(calibration_of(turned, 1.0)), Contains(HasSubstr("K_t is below 0")));
    EXPECT_THAT(warnings_of(calibration_of(known_coefficients(), 4.0)), Contains(HasSubstr("scatter more")));
    Coefficients sharp = known_coefficients();
    sharp.tail<3>().setZero();
    EXPECT_THAT(warnings_of(calibration_of(sharp, 0.0)), Contains(HasSubstr("K_te may be 0")));
}

TEST(CalibrationReport, WritesALineForEachForce) {
    const std::string csv = residuals_of({calibration_of(known_coefficients(), 1.0)}).csv();
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 36);
    EXPECT_THAT(csv, HasSubstr("\n12,"));
}

TEST(CalibrationReport, WritesAFragmentThatASceneTakes) {
    Coefficients known = known_coefficients();
    known(5) = -0.3;  // a scene refuses it
    const std::string fragment = scene_fragment({calibration_of(known, 0.0)}, "runs.csv");
    EXPECT_THAT(fragment, HasSubstr("K_ae is below 0"));
    EXPECT_THAT(fragment, HasSubstr("12 runs of runs.csv"));
    const Scene scene = parse_scene("name = \"cube\"\n[bone]\nphantom = \"cube\"\n" + fragment, "scene.toml");
    ASSERT_EQ(scene.burrs.size(), 1u);
    const Burr& burr = scene.burrs.front();
    EXPECT_NEAR(burr.cutting_coefficients_n_per_mm2.x, 230.0, 0.01);
    EXPECT_NEAR(burr.edge_coefficients_n_per_mm.y, 0.8, 1e-4);
    EXPECT_EQ(burr.edge_coefficients_n_per_mm.z, 0.0);
    EXPECT_EQ(burr.edges, 8);
}

}  // namespace
}  // namespace osteomill::study
