#include "studies/force/pareto.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace osteomill::study {
namespace {

using ::testing::HasSubstr;

TEST(ParetoSettings, MarkTheDefaultAndNameEachOnce) {
    const auto settings = pareto_settings(false);
    EXPECT_EQ(
        std::count_if(settings.begin(), settings.end(), [](const ParetoSetting& s) { return s.is_default; }),
        1);
    for (const ParetoSetting& s : settings) {
        EXPECT_EQ(s.family.find(','), std::string::npos)
            << "the chart reads tables without quotes: " << s.family;
        EXPECT_EQ(
            std::count_if(settings.begin(), settings.end(),
                          [&](const ParetoSetting& t) { return t.family == s.family && t.label == s.label; }),
            1)
            << s.family << ' ' << s.label;
    }
    EXPECT_LT(pareto_settings(true).size(), settings.size());
}

/// Feels a steady force whatever happens.
class Steady final : public StudiedModel {
  public:
    explicit Steady(Bone bone) : bone_(std::move(bone)) {}
    StepOutcome step(const BurrCommand&) override { return {{1.5, 0.0, 0.0}, 0.1}; }
    const Bone& bone() const override { return bone_; }

  private:
    Bone bone_;
};

TEST(ParetoPoint, HoldsTheErrorOfEachMotionAndTheirMean) {
    const auto motion = [](const std::string& name, const glm::dvec3& reference_n) {
        return StudiedMotion{.name = name,
                             .burr = {.diameter_mm = 1.0},
                             .position_mm = [](double t) { return glm::dvec3(t, 0.0, 0.0); },
                             .duration_s = 0.1,
                             .reference_n = reference_n};
    };
    const std::vector motions{motion("one", {1.0, 0.0, 0.0}), motion("two", {1.2, 0.0, 0.0})};
    const ParetoSetting setting{.family = "steady", .label = "still", .make = [](Bone bone, const Burr&) {
                                    return std::make_unique<Steady>(std::move(bone));
                                }};
    const ParetoPoint point = measure(setting, motions, true);
    ASSERT_EQ(point.errors.size(), 2u);
    EXPECT_DOUBLE_EQ(point.errors[0], 0.5);
    EXPECT_DOUBLE_EQ(point.errors[1], 0.25);
    EXPECT_DOUBLE_EQ(point.mean_error, 0.375);
    EXPECT_EQ(point.worst_ripple, 0.0);
    const std::string csv = csv_of({point}, motions);
    EXPECT_THAT(csv, HasSubstr("family,label,voxel_mm"));
    EXPECT_THAT(csv, HasSubstr("steady,still,0.1,100,"));
    EXPECT_THAT(csv, HasSubstr(",37.5000,0.0000,0,50.0000,25.0000\n"));
}

}  // namespace
}  // namespace osteomill::study
