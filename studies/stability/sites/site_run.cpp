#include "studies/stability/sites/site_run.h"

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <numeric>

#include "common/bone/brick_change.h"
#include "devices/simulated/simulated_device.h"
#include "simulation/force_models/milling_model.h"
#include "simulation/loop/milling_session.h"
#include "studies/stability/map/scene_plan.h"
#include "studies/stability/sites/site.h"

namespace osteomill::study {
namespace {

constexpr double most_patience = 3.0;
constexpr int rigid_steps_per_tick = 50;

ArmModel arm_of(const SiteHand& hand) {
    ArmModel arm;
    if (hand.is_ideal_device) arm.coulomb_friction_n = arm.resolution_mm = 0.0;
    return arm;
}

/// A simulated arm whose forces come late, and which keeps a record.
class SiteDevice final : public HapticDevice {
  public:
    SiteDevice(const Site& site, const SiteHand& hand)
        : arm_(Trajectory(site.motion), DeviceMapping{}, arm_of(hand), hand_model(hand.grip)),
          in_delay_n_(static_cast<std::size_t>(hand.delay_ticks), glm::dvec3(0.0)) {}

    /// Called at a tick's begin, with the record of those before.
    void on_tick(std::function<void(std::vector<SiteTick>&)> observer) { observer_ = std::move(observer); }

    std::string name() const override { return "arm at a site"; }
    DeviceLimits limits() const override { return arm_.limits(); }
    void start() override {}
    DeviceState read(double now_s) noexcept override {
        const DeviceState state = arm_.read(now_s);
        if (observer_) observer_(record_);
        record_.push_back({.hand_mm = arm_.held_arm().truth().position_mm()});
        return state;
    }
    void write(const glm::dvec3& force_n) noexcept override {
        in_delay_n_.push_back(force_n);
        record_.back().force_n = in_delay_n_.front();
        in_delay_n_.pop_front();
        arm_.write(record_.back().force_n);
    }
    void stop() noexcept override {}

    bool is_finished() const { return arm_.is_finished(); }
    std::vector<SiteTick> take_record() { return std::move(record_); }

  private:
    SimulatedDevice arm_;
    std::deque<glm::dvec3> in_delay_n_;
    std::function<void(std::vector<SiteTick>&)> observer_;
    std::vector<SiteTick> record_;
};

/// The milling model's mean force in each tick along a path of the record, with the record's spindle.
void mill_along(const Bone& bone, const Burr& burr, std::vector<SiteTick>& ticks,
                glm::dvec3 SiteTick::*path_mm, int steps_per_tick, glm::dvec3 SiteTick::*force_n) {
    MillingModel model(bone, {burr}, {});
    ForgottenChanges changes;
    const auto result = std::make_unique<MillingResult>();
    const double step_s = tick_s / steps_per_tick;
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        const glm::dvec3 from_mm = ticks[i > 0 ? i - 1 : 0].*path_mm;
        const glm::dvec3 way_mm = ticks[i].*path_mm - from_mm;
        glm::dvec3 sum_n(0.0);
        for (int step = 1; step <= steps_per_tick; ++step) {
            const double share = static_cast<double>(step) / steps_per_tick;
            model.step({.pose = {from_mm + share * way_mm, ticks[i].spindle_axis},
                        .spindle_on = ticks[i].spindle_on,
                        .elapsed_s = step_s,
                        .wants_engagement = false},
                       tick_s * static_cast<double>(i), changes, *result);
            sum_n += result->force_n;
        }
        ticks[i].*force_n = sum_n / static_cast<double>(steps_per_tick);
    }
}

}  // namespace

SiteRun run_site(const Site& site, const SiteHand& hand) {
    const Bone bone = site_bone(site.shape);
    SiteDevice device(site, hand);
    Scene scene;
    scene.burrs = {site.burr};
    scene.feed_forward = hand.feed_forward;
    scene.start_pose = site.motion.front().pose;
    MillingSession session(scene, bone, device,
                           {.clock = ClockKind::virtual_time,
                            .coupling = coupling_named(hand.method),
                            .duration_s = most_patience * site.motion.back().time_s});
    std::atomic<bool> stop{false};
    device.on_tick([&](std::vector<SiteTick>& record) {
        if (record.empty()) return;
        session.exchange().tool.refresh();
        record.back().burr_mm = session.exchange().tool.front().burr_position_mm;
        record.back().spindle_axis = session.exchange().tool.front().spindle_axis;
        record.back().spindle_on = session.exchange().tool.front().spindle_on;
        if (device.is_finished()) stop.store(true);
    });
    session.run(stop);

    const auto& faults = session.fault_counts();
    SiteRun run{.ticks = device.take_record(),
                .solve = session.solve_counts(),
                .faults = std::accumulate(faults.begin(), faults.end(), std::uint64_t{0})};
    run.ticks.pop_back();  // whose end nobody saw
    mill_along(bone, site.burr, run.ticks, &SiteTick::burr_mm, 1, &SiteTick::model_n);
    mill_along(bone, site.burr, run.ticks, &SiteTick::hand_mm, rigid_steps_per_tick, &SiteTick::rigid_n);
    return run;
}

}  // namespace osteomill::study
