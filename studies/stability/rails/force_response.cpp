#include "studies/stability/rails/force_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "analysis/output/study_run.h"
#include "simulation/coupling/couplings.h"
#include "simulation/force_models/milling_model.h"
#include "studies/force/bone_block.h"

namespace osteomill::study {
namespace {

constexpr double sample_s = 0.001;
constexpr double block_voxel_mm = 0.1;
constexpr double slot_depth_mm = 1.0;
constexpr double feed_mm_per_s = 4.0;
constexpr double swing_mm_per_s = 1.0;
constexpr double settling_s = 3.0;
constexpr double least_measured_s = 1.0;
constexpr int least_periods = 2;
constexpr std::array frequencies_hz{0.3, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 30.0};

struct Choice {
    const char* coupling;
    double stiffness_n_per_mm;
};
/// What the simulated arm can render and what softer and stiffer ones would make of it.
constexpr std::array choices{Choice{"implicit", 0.5},
                             Choice{"implicit", 1.5},
                             Choice{"implicit", 5.0},
                             Choice{"implicit", 15.0},
                             Choice{"sample-estimate-hold", 1.5},
                             Choice{"interpolate", 1.5}};

/// A component at one frequency, of samples over whole periods.
class Component {
  public:
    Component(double hz, double measured_s) : hz_(hz), scale_(2.0 * sample_s / measured_s) {}
    void add(double time_s, const glm::dvec3& value) {
        const auto turned = scale_ * std::polar(1.0, -2.0 * std::numbers::pi * hz_ * time_s);
        for (int k = 0; k < 3; ++k) sum_[static_cast<std::size_t>(k)] += turned * value[k];
    }
    const std::array<std::complex<double>, 3>& sum() const { return sum_; }

  private:
    double hz_;
    double scale_;
    std::array<std::complex<double>, 3> sum_{};
};

/// <a, b>, linear in a.
std::complex<double> product(const Component& a, const Component& b) {
    std::complex<double> sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) sum += a.sum()[k] * std::conj(b.sum()[k]);
    return sum;
}

double hand_x_mm(double time_s, double hz) {
    const double w = 2.0 * std::numbers::pi * hz;
    return feed_mm_per_s * time_s + swing_mm_per_s / w * std::sin(w * time_s);
}

}  // namespace

ForceResponse respond(const std::string& coupling_name, double stiffness_n_per_mm, double hz) {
    if (!(hz >= 0.1 && hz <= 100.0))
        throw std::invalid_argument(fmt::format("a frequency of {} Hz is not within 0.1 to 100", hz));
    const Burr burr{.diameter_mm = 5.0, .spindle_rev_per_s = 10'000.0 / 60.0};
    const double periods = std::max<double>(least_periods, std::ceil(least_measured_s * hz));
    const int settling_ticks = static_cast<int>(settling_s / sample_s);
    const int measured_ticks = static_cast<int>(std::lround(periods / hz / sample_s));
    const double end_mm = hand_x_mm((settling_ticks + measured_ticks) * sample_s, hz);

    const double z_mm = burr.radius_mm() - slot_depth_mm;
    const double margin_mm = burr.radius_mm() + 3.0;
    const Bone bone = voxelised({.low_mm = {-margin_mm, -margin_mm, z_mm - margin_mm},
                                 .high_mm = {end_mm + margin_mm, margin_mm, z_mm + margin_mm}},
                                block_voxel_mm);
    MillingModel model(bone, {burr}, {});
    MillingModel rigid(bone, {burr}, {});
    CouplingOptions options;
    options.device.max_stiffness_n_per_mm = stiffness_n_per_mm;
    const auto coupling = make_coupling(coupling_name, options);
    ForgottenChanges changes;
    const auto latest = std::make_unique<MillingResult>();
    const auto rigid_latest = std::make_unique<MillingResult>();
    const auto mill = [&](MillingModel& with, const ToolPose& pose, bool spindle_on, double now_s,
                          MillingResult& result) {
        with.step({.pose = pose, .spindle_on = spindle_on, .elapsed_s = sample_s}, now_s, changes, result);
    };
    const ToolPose start{{0.0, 0.0, z_mm}, {0.0, 0.0, 1.0}};
    for (const bool spindle_on : {false, true}) {
        mill(model, start, spindle_on, spindle_on ? 0.0 : -sample_s, *latest);
        mill(rigid, start, spindle_on, spindle_on ? 0.0 : -sample_s, *rigid_latest);
    }

    Component felt(hz, measured_ticks * sample_s);
    Component truth(hz, measured_ticks * sample_s);
    for (int tick = 1; tick <= settling_ticks + measured_ticks; ++tick) {
        const double now_s = tick * sample_s;
        const HandState hand{
            .now_s = now_s,
            .tick_s = sample_s,
            .pose = {{hand_x_mm(now_s, hz), 0.0, z_mm}, start.spindle_axis},
            .velocity_mm_per_s = {feed_mm_per_s +
                                      swing_mm_per_s * std::cos(2.0 * std::numbers::pi * hz * now_s),
                                  0.0, 0.0},
            .spindle_on = true};
        const CouplingOutput out = coupling->tick(hand, *latest);
        mill(model, out.burr_pose, true, now_s, *latest);
        mill(rigid, hand.pose, true, now_s, *rigid_latest);
        if (tick <= settling_ticks) continue;
        felt.add(now_s, out.force_n);
        truth.add(now_s, rigid_latest->force_n);
    }
    const double rigid_n = std::sqrt(product(truth, truth).real());
    return {.response = product(felt, truth) / product(truth, truth),
            .rigid_n_s_per_m = 1000.0 * rigid_n / swing_mm_per_s};
}

void run_response_study(const std::filesystem::path& out, const StudySurroundings& surroundings) {
    struct Point {
        Choice choice;
        double hz;
    };
    std::vector<Point> points;
    for (const Choice& choice : choices)
        for (const double hz : frequencies_hz) points.push_back({choice, hz});
    StudyRun run(out, surroundings);
    const auto planned = run.plan(
        points,
        [](const Point& p) {
            return fmt::format("{}, {} N/mm, {} Hz", p.choice.coupling, p.choice.stiffness_n_per_mm, p.hz);
        },
        [](const Point& p) -> std::array<double, 3> {
            const ForceResponse r = respond(p.choice.coupling, p.choice.stiffness_n_per_mm, p.hz);
            return {std::abs(r.response), 180.0 / std::numbers::pi * std::arg(r.response), r.rigid_n_s_per_m};
        });
    if (!run.perform()) return;
    Table table({"coupling", "stiffness_n_per_mm", "hz", "gain", "phase_deg", "rigid_n_s_per_m"});
    auto point = points.begin();
    for (const auto& [gain, phase_deg, rigid_n_s_per_m] : planned.outcomes()) {
        table.add({point->choice.coupling, point->choice.stiffness_n_per_mm, point->hz, gain, phase_deg,
                   rigid_n_s_per_m});
        ++point;
    }
    run.write(table, "response");
    run.draw({"response"});
    run.say("{}", table.csv());
}

}  // namespace osteomill::study
