#include "haptic_server/session/measured_device.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "simulation/device/measured_arm.h"

namespace osteomill {

namespace {

class MeasuredDevice final : public HapticDevice {
  public:
    MeasuredDevice(std::unique_ptr<HapticDevice> device, double delay_s, const MeasuredArm& measured)
        : device_(std::move(device)), delay_s_(delay_s), measured_(measured) {}

    std::string name() const override { return device_->name(); }
    DeviceLimits limits() const override {
        return with_measured_spring(device_->limits(), delay_s_, measured_);
    }
    void start() override { device_->start(); }
    DeviceState read(double now_s) noexcept override { return device_->read(now_s); }
    void write(const glm::dvec3& force_n) noexcept override { device_->write(force_n); }
    void stop() noexcept override { device_->stop(); }
    void set_mapping(const DeviceMapping& mapping) noexcept override { device_->set_mapping(mapping); }
    const char* notice() const noexcept override { return device_->notice(); }

  private:
    std::unique_ptr<HapticDevice> device_;
    double delay_s_;
    MeasuredArm measured_;
};

}  // namespace

DeviceOption measured_profile_option() {
    return {.flag = device_profile_flag,
            .type_name = "NAME|FILE.toml",
            .help = "The profile that --measure-arm wrote for this arm",
            .names_file = true,
            .is_replaced_by = save_profile_flag};
}

std::function<std::optional<MeasuredProfile>()> typed_measured_profile(const TypedOptions& typed) {
    const std::optional<std::string> file = typed.given(device_profile_flag);
    if (file && std::filesystem::path(*file).extension() != ".toml")
        throw std::invalid_argument(fmt::format(
            "{}: '{}' goes with --device hid; others take the .toml file that --measure-arm wrote",
            device_profile_flag, *file));
    return [file] { return file ? std::optional(load_measured_profile(*file)) : std::nullopt; };
}

DeviceParts with_measured(DeviceParts parts, const std::optional<MeasuredProfile>& profile,
                          const DeviceContext& context) {
    if (!profile || parts.device == nullptr || context.as_stated) return parts;
    const std::string name = parts.device->name();
    if (profile->arm != name)
        throw std::runtime_error(
            fmt::format("{}: was measured on the arm '{}', and this is '{}'; measure it with --measure-arm",
                        device_profile_flag, profile->arm, name));
    parts.device =
        std::make_unique<MeasuredDevice>(std::move(parts.device), parts.delay_s, profile->measured);
    return parts;
}

}  // namespace osteomill
