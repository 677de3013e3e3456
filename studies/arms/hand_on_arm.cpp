#include "studies/arms/hand_on_arm.h"

#include <algorithm>
#include <atomic>

#include "devices/haply/haply_arm.h"
#include "devices/hid/arm_kinematics.h"
#include "devices/hid/arm_profile.h"
#include "devices/simulated/simulated_device.h"
#include "simulation/loop/milling_session.h"

namespace osteomill::study {

namespace {

/// A simulated arm that keeps the forces written to it.
class NotingDevice final : public HapticDevice {
  public:
    NotingDevice(const Scene& scene, const HandOnArm& choice)
        : arm_(make_trajectory(scene.trajectory, scene.start_pose, scene.burrs, scene.start_burr),
               scene.device, choice.arm, choice.hand),
          limits_(arm_.limits()) {
        if (choice.stiffness_n_per_mm) limits_.max_stiffness_n_per_mm = *choice.stiffness_n_per_mm;
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
    std::vector<glm::dvec3> take_forces_n() { return std::move(forces_n_); }

  private:
    SimulatedDevice arm_;
    DeviceLimits limits_;
    std::vector<glm::dvec3> forces_n_;
};

}  // namespace

std::vector<glm::dvec3> forces_of(const Scene& scene, const Bone& bone, const HandOnArm& choice) {
    NotingDevice device(scene, choice);
    MillingSession session(scene, bone, device,
                           {.clock = ClockKind::virtual_time,
                            .milling_rate_hz = choice.milling_rate_hz,
                            .coupling = coupling_named(choice.coupling),
                            .force_model = choice.force_model,
                            .duration_s = choice.longest_s});
    std::atomic<bool> is_over{false};
    session.run(is_over, [&](const ToolState& tool) {
        if (device.is_finished() || !tool.fault.empty()) is_over.store(true);
    });
    return device.take_forces_n();
}

std::vector<std::pair<std::string, ArmModel>> shipped_arms() {
    std::vector<std::pair<std::string, ArmModel>> arms{{"simulated", ArmModel{}}};
    for (const std::string& name : shipped_profile_names()) {
        const ArmProfile profile = load_arm_profile(name);
        constexpr double m_per_mm = 0.001;
        arms.emplace_back(name, ArmModel{.mass_kg = profile.apparent_mass_kg,
                                         .resolution_mm = ArmKinematics(profile).resolution_mm(),
                                         .max_force_n = profile.max_force_n,
                                         .max_stiffness_n_per_mm = m_per_mm * profile.max_stiffness_n_per_m});
    }
    arms.emplace_back("inverse3",
                      ArmModel{.mass_kg = inverse3_profile.apparent_mass_kg,
                               .resolution_mm = inverse3_profile.position_step_mm,
                               .max_force_n = inverse3_profile.max_force_n,
                               .max_stiffness_n_per_mm = inverse3_profile.max_stiffness_n_per_mm});
    return arms;
}

}  // namespace osteomill::study
