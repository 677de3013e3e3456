#include "haptic_server/program/measure_arm.h"

#include <fmt/format.h>

#include <stdexcept>

#include "common/files/atomic_file.h"
#include "devices/measured/measured_profile.h"
#include "devices/simulated/simulated_device.h"
#include "haptic_server/measuring/arm_measurement.h"
#include "imaging/phantoms/phantom.h"

namespace osteomill {

namespace {

/// The simulated arm in a hand that holds it at a place, with the pedal down.
DeviceParts held_arm(const Scene& scene, Grip grip) {
    DeviceParts parts;
    parts.device = std::make_unique<SimulatedDevice>(
        Trajectory({{.time_s = 0.0, .pose = scene.start_pose, .pedal = true}}), scene.device, ArmModel{},
        hand_model(grip));
    parts.delay_s = 0.0;
    return parts;
}

}  // namespace

void run_measuring(const ServerOptions& options, const std::atomic<bool>& stop, const ProgramOutput& output) {
    const std::filesystem::path& file = *options.measures_into;
    const Scene scene = phantom_scene("tooth");  // a device is made for a scene; none is milled
    const auto say = [&](const std::string& line) { output.err->say(line); };
    const DeviceEntry& entry = *options.device.entry;
    const DeviceParts parts =
        entry.is_simulated
            ? held_arm(scene, options.grip.value_or(Grip::firm))
            : options.device.prepare()(
                  {.scene = scene, .grip = options.grip, .stop = stop, .say = say, .as_stated = true});
    if (parts.device == nullptr) return;  // stopped before an arm came
    const DeviceLimits stated = parts.device->limits();
    const ArmMeasurement found =
        measure_arm(*parts.device, {.delay_s = parts.delay_s,
                                    .is_virtual = options.milling.clock == ClockKind::virtual_time,
                                    .stop = stop,
                                    .say = say});
    const std::string name = parts.device->name();
    output.out->write(text_of(found, name, stated, parts.delay_s));
    if (!found.has_spring())
        throw std::runtime_error(fmt::format(
            "the measurement ended without a spring: {}; nothing was written", why_no_spring(found)));
    write_atomic_file(file, parts.profile.empty()
                                ? measured_profile_text({.arm = name, .measured = found.arm})
                                : with_measured_table(parts.profile, found.arm));
    output.out->write(fmt::format("{} is written: haptic_server --device {} --device-profile {}\n",
                                  file.string(), entry.name, file.string()));
}

}  // namespace osteomill
