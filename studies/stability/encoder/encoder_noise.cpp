#include "studies/stability/encoder/encoder_noise.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>
#include <variant>

#include "analysis/output/study_run.h"
#include "devices/simulated/simulated_device.h"
#include "imaging/bone_from_hu.h"
#include "imaging/phantoms/phantom.h"
#include "simulation/loop/milling_session.h"

namespace osteomill::study {
namespace {

constexpr double tick_s = MillingSession::tick_s;
constexpr double lowest_noise_hz = 5.0;
constexpr double least_force_n = 0.005;
constexpr double felt_jump_n = 0.03;
constexpr std::array steps_mm{0.0, 0.003, 0.006, 0.0125, 0.025, 0.055, 0.1};

/// Butterworth's, of second order, as if what came before the first value had been the same.
class HighPass {
  public:
    glm::dvec3 operator()(const glm::dvec3& now) {
        if (is_first_) before_ = before_that_ = now;
        is_first_ = false;
        static const double w = std::tan(std::numbers::pi * lowest_noise_hz * tick_s);
        static const double n = 1.0 / (1.0 + std::numbers::sqrt2 * w + w * w);
        const glm::dvec3 out = n * (now - 2.0 * before_ + before_that_) - 2.0 * (w * w - 1.0) * n * out_ -
                               (1.0 - std::numbers::sqrt2 * w + w * w) * n * out_before_;
        before_that_ = before_;
        before_ = now;
        out_before_ = out_;
        out_ = out;
        return out;
    }

  private:
    bool is_first_ = true;
    glm::dvec3 before_{0.0}, before_that_{0.0}, out_{0.0}, out_before_{0.0};
};

/// The tooth, each tissue of which cuts like that one.
Scene tooth_of(const std::string& tissue) {
    Scene scene = phantom_scene("tooth");
    const auto found = std::ranges::find(scene.tissues, tissue, &Tissue::name);
    if (found == scene.tissues.end()) throw std::invalid_argument("the tooth has no tissue " + tissue);
    const std::optional<TissueStrength> strength = found->strength;
    for (Tissue& each : scene.tissues) each.strength = strength;
    return scene;
}

/// A simulated arm that keeps the forces written to it.
class NotingDevice final : public HapticDevice {
  public:
    NotingDevice(const Scene& scene, const ArmModel& arm, std::optional<double> stiffness_n_per_mm)
        : arm_(make_trajectory(scene.trajectory, scene.start_pose, scene.burrs, scene.start_burr),
               scene.device, arm, hand_model(Grip::firm)),
          limits_(arm_.limits()) {
        if (stiffness_n_per_mm) limits_.max_stiffness_n_per_mm = *stiffness_n_per_mm;
    }

    std::string name() const override { return arm_.name(); }
    DeviceLimits limits() const override { return limits_; }
    void start() override {}
    DeviceState read(double now_s) noexcept override { return arm_.read(now_s); }
    void write(const glm::dvec3& force_n) noexcept override {
        forces_n_.push_back(force_n);
        arm_.write(force_n);
    }
    void stop() noexcept override {}

    bool is_finished() const { return arm_.is_finished(); }
    const std::vector<glm::dvec3>& forces_n() const { return forces_n_; }

  private:
    SimulatedDevice arm_;
    DeviceLimits limits_;
    std::vector<glm::dvec3> forces_n_;
};

}  // namespace

EncoderNoise noise_of(const std::vector<glm::dvec3>& forces_n) {
    EncoderNoise noise;
    HighPass high_pass;
    double squares_n2 = 0.0;
    std::size_t felt = 0;
    std::size_t jumps = 0;
    for (std::size_t i = 0; i < forces_n.size(); ++i) {
        const glm::dvec3 above_n = high_pass(forces_n[i]);
        if (i > 0) {
            const double jump_n = glm::distance(forces_n[i], forces_n[i - 1]);
            noise.largest_jump_n = std::max(noise.largest_jump_n, jump_n);
            jumps += jump_n > felt_jump_n ? 1 : 0;
        }
        if (glm::length(forces_n[i]) < least_force_n) continue;
        ++felt;
        noise.mean_force_n += glm::length(forces_n[i]);
        squares_n2 += glm::dot(above_n, above_n);
    }
    if (felt == 0) return noise;
    const auto ticks = static_cast<double>(felt);
    noise.mean_force_n /= ticks;
    noise.noise_n = std::sqrt(squares_n2 / ticks);
    noise.jumps_per_s = static_cast<double>(jumps) / (ticks * tick_s);
    return noise;
}

EncoderNoise drill_tooth(const ArmModel& arm, const std::string& coupling,
                         std::optional<double> stiffness_n_per_mm, const std::string& all_of) {
    const Scene scene = all_of.empty() ? phantom_scene("tooth") : tooth_of(all_of);
    NotingDevice device(scene, arm, stiffness_n_per_mm);
    MillingSession session(
        scene,
        bone_from_hu(std::get<HuSlices>(make_phantom("tooth")), phantom_threshold_hu, stiffness_of(scene)),
        device, {.clock = ClockKind::virtual_time, .coupling = coupling});
    std::atomic<bool> is_over{false};
    session.run(is_over, [&](const ToolState&) {
        if (device.is_finished()) is_over.store(true);
    });
    return noise_of(device.forces_n());
}

void run_encoder_study(const std::string& coupling, const std::filesystem::path& out,
                       const StudySurroundings& surroundings) {
    StudyRun run(out, surroundings);
    const auto planned = run.plan(
        std::vector(steps_mm.begin(), steps_mm.end()),
        [](double step_mm) { return fmt::format("steps of {} mm", step_mm); },
        [&](double step_mm) { return drill_tooth({.resolution_mm = step_mm}, coupling); });
    if (!run.perform()) return;
    Table table({"step_mm", "mean_force_n", "noise_n", "noise_percent", "largest_jump_n", "jumps_per_s"});
    auto step_mm = steps_mm.begin();
    for (const EncoderNoise& a : planned.outcomes())
        table.add({*step_mm++, a.mean_force_n, a.noise_n,
                   a.mean_force_n > 0.0 ? 100.0 * a.noise_n / a.mean_force_n : 0.0, a.largest_jump_n,
                   a.jumps_per_s});
    run.write(table, "encoder");
    run.draw({"encoder"});
    run.say("{}", table.csv());
}

}  // namespace osteomill::study
