#include "devices/hid/hid_arm.h"

#include <fmt/format.h>

#include <utility>

#include "devices/hid/arm_link.h"
#include "simulation/device/arm_spring.h"

namespace osteomill {

namespace {

/// An arm answers within a millisecond or two; this is how long the thread sleeps if it does not.
constexpr int longest_report_wait_ms = 5;

class ArmConversation final : public HidConversation {
  public:
    ArmConversation(const ArmProfile& profile, std::unique_ptr<HidConnection> connection,
                    std::function<double()> clock_s, std::uint64_t number, ArmReadings& readings,
                    TripleBuffer<glm::dvec3>& forces)
        : connection_(std::move(connection)),
          clock_s_(std::move(clock_s)),
          number_(number),
          link_(profile, *connection_, clock_s_()),
          readings_(readings),
          forces_(forces) {
        forces_.refresh();  // a force wanted before it was unplugged is not meant for it now
    }

    bool exchange() noexcept override {
        link_.receive(longest_report_wait_ms, clock_s_());
        std::optional<glm::dvec3> wanted_n;
        if (forces_.refresh()) wanted_n = forces_.front();
        link_.answer(clock_s_(), wanted_n);
        ArmReading reading{.state = link_.reading(), .knows_pedal = true};
        reading.state.pedal.speaker = number_;
        reading.said_s = reading.state.pedal.said_s;
        readings_.publish(reading);
        return link_.state() != ArmLink::State::gone;
    }

    const char* notice() const noexcept override { return link_.notice(); }

  private:
    std::unique_ptr<HidConnection> connection_;
    std::function<double()> clock_s_;
    std::uint64_t number_;
    ArmLink link_;
    ArmReadings& readings_;
    TripleBuffer<glm::dvec3>& forces_;
};

HidWorkerParts parts_of(const ArmProfile& profile, HidTransport& transport, std::function<double()> clock_s,
                        std::function<void()> on_thread_start, ArmReadings& readings,
                        TripleBuffer<glm::dvec3>& forces) {
    return {
        .transport = transport,
        .is_wanted = [usb = profile.usb](const HidDeviceInfo& device) { return is_arm_of(usb, device); },
        .what = fmt::format("haptic arm {} (USB {:04x}:{:04x}, usage {:04x}:{:04x})", profile.name,
                            profile.usb.vendor_id, profile.usb.product_id, profile.usb.usage_page,
                            profile.usb.usage),
        .begin = [profile, clock_s = std::move(clock_s), number = std::uint64_t{0}, &readings, &forces](
                     std::unique_ptr<HidConnection> connection) mutable -> std::unique_ptr<HidConversation> {
            return std::make_unique<ArmConversation>(profile, std::move(connection), clock_s, ++number,
                                                     readings, forces);
        },
        .on_thread_start = std::move(on_thread_start)};
}

}  // namespace

HidArm::HidArm(ArmProfile profile, HidTransport& transport, std::function<double()> clock_s,
               std::function<void()> on_thread_start)
    : profile_(std::move(profile)),
      readings_(clock_s),
      worker_(parts_of(profile_, transport, std::move(clock_s), std::move(on_thread_start), readings_,
                       forces_)) {}

DeviceLimits HidArm::limits() const {
    constexpr double m_per_mm = 0.001;
    constexpr double delay_s = 0.001;  // an answer to each report
    return with_stiffest_spring({.max_force_n = profile_.max_force_n,
                                 .max_stiffness_n_per_mm = m_per_mm * profile_.max_stiffness_n_per_m,
                                 .apparent_mass_kg = profile_.apparent_mass_kg,
                                 .position_resolution_mm = ArmKinematics(profile_).resolution_mm()},
                                delay_s);
}

void HidArm::write(const glm::dvec3& force_n) noexcept {
    forces_.back() = force_n;
    forces_.publish();
}

glm::dvec3 home_position_mm(const ArmProfile& profile) {
    const ArmKinematics kinematics(profile);
    return kinematics.position_mm(kinematics.angles_rad(profile.home_counts));
}

bool is_arm_of(const HidIdentity& identity, const HidDeviceInfo& device) {
    return device.vendor_id == identity.vendor_id && device.product_id == identity.product_id &&
           device.usage_page == identity.usage_page && device.usage == identity.usage;
}

}  // namespace osteomill
