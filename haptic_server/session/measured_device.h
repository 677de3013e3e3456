// A device with the spring that a measurement of it allows (measured_arm.h).
#pragma once

#include <functional>
#include <optional>

#include "devices/measured/measured_profile.h"
#include "haptic_server/session/device_table.h"

namespace osteomill {

inline constexpr const char* device_profile_flag = "--device-profile";
/// Where --measure-arm writes: over the profile that it read, too.
inline constexpr const char* save_profile_flag = "--save-profile";
inline constexpr const char* usual_measured_profile = "measured_arm.toml";

/// The option of devices that know their arm by themselves, and take only what was measured on it.
DeviceOption measured_profile_option();

/// The typed profile, if one was: a file, to be read when it is called. Throws std::invalid_argument for a
/// text that names none; what it gives throws as load_measured_profile does.
std::function<std::optional<MeasuredProfile>()> typed_measured_profile(const TypedOptions& typed);

/// The device in `parts` with that spring in its limits, if there is a profile, and the context does not want
/// it as stated. Throws std::runtime_error with one line for a profile of an arm of another name.
DeviceParts with_measured(DeviceParts parts, const std::optional<MeasuredProfile>& profile,
                          const DeviceContext& context);

}  // namespace osteomill
