#include "studies/arms/force_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

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
constexpr double transient_s = 3.0;
constexpr double least_measured_s = 1.0;
constexpr int least_periods = 2;

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
    if (!(stiffness_n_per_mm > 0.0))
        throw std::invalid_argument(fmt::format("a stiffness of {} N/mm is not above 0", stiffness_n_per_mm));
    const Burr burr{.diameter_mm = 5.0, .spindle_rev_per_s = 10'000.0 / 60.0};
    const double periods = std::max<double>(least_periods, std::ceil(least_measured_s * hz));
    const int settling_ticks = static_cast<int>(transient_s / sample_s);
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
    const auto coupling = make_coupling(coupling_named(coupling_name), options);
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

}  // namespace osteomill::study
