// The devices that --device takes. To add one is a file and a row: the file has a function that gives the
// row, as those of haptic_server/session/devices do.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/scene/scene.h"
#include "devices/hid/hid_transport.h"
#include "devices/simulated/hand_and_arm.h"
#include "devices/simulated/simulated_device.h"
#include "simulation/coupling/couplings.h"
#include "simulation/device/haptic_device.h"
#include "simulation/exchange/operator_channel.h"

namespace osteomill {

// A kind of device on the command line: a row of device_table.cpp.

/// The device, and the sources that drive it.
struct DeviceParts {
    std::unique_ptr<HidTransport> transport{};            ///< null: the device is not plugged in
    std::unique_ptr<OperatorChannel> operator_channel{};  ///< null: no client may drive
    std::unique_ptr<HapticDevice> device{};               ///< null: a stop came before the device
    const SimulatedDevice* simulated = nullptr;           ///< `device`, if it is one
    /// The point of device space for the scene's start pose, if the scene does not place the device on the
    /// patient.
    std::optional<glm::dvec3> home_mm{};
    /// The device's place on the patient, overriding the scene: for a device that knows it.
    std::optional<DeviceMapping> mapping{};
    double delay_s = 0.001;  ///< from a reading to its force, as far as the driver knows
    std::string profile{};   ///< the text of the arm's profile; empty: the arm says itself what it is

    bool is_finished() const { return simulated != nullptr && simulated->is_finished(); }
};

/// The context in which a device is made.
struct DeviceContext {
    const Scene& scene;
    std::optional<Grip> grip;       ///< a simulated hand's grip; nothing: the simulated hand is on rails
    const std::atomic<bool>& stop;  ///< ends a wait for an arm
    /// Called with messages for people while an arm is awaited.
    std::function<void(const std::string&)> say = [](const std::string&) {};
    bool as_stated = false;  ///< without the spring of a measured profile: it is about to be measured
};

/// Throws std::runtime_error in one line.
using MakeDevice = std::function<DeviceParts(const DeviceContext&)>;
/// Reads the small files that the device needs, so that an error shows before a bone is loaded. Throws
/// std::runtime_error in one line.
using PrepareDevice = std::function<MakeDevice()>;

/// For a device with no such file.
inline PrepareDevice at_once(MakeDevice make) {
    return [make = std::move(make)] { return make; };
}

/// An option that goes with one device.
struct DeviceOption {
    const char* flag;
    const char* type_name;
    std::string help;
    bool names_file = false;          ///< which is read, so nothing may be written over it
    const char* is_replaced_by = "";  ///< but what that option writes
};

/// The typed options of a device, by flag; options that were not typed are absent.
class TypedOptions {
  public:
    explicit TypedOptions(std::map<std::string, std::string> texts = {}) : texts_(std::move(texts)) {}
    std::optional<std::string> given(const char* flag) const {
        const auto found = texts_.find(flag);
        return found != texts_.end() ? std::optional(found->second) : std::nullopt;
    }
    /// The value that `parse` makes of the text, or `usual` without a text. Its exceptions name the option.
    template <typename Value, typename Parse>
    Value parsed(const char* flag, Value usual, const Parse& parse) const {
        const std::optional<std::string> text = given(flag);
        if (!text) return usual;
        try {
            return parse(*text);
        } catch (const std::invalid_argument& error) {
            throw std::invalid_argument(std::string(flag) + ": " + error.what());
        }
    }

  private:
    std::map<std::string, std::string> texts_;
};

struct DeviceEntry {
    const char* name;
    const char* text;  ///< for --help: the mover of the tool
    std::vector<DeviceOption> options{};
    /// The coupling that suits it, unless the command line names one; nothing: the force model's.
    std::optional<CouplingKind> coupling{};
    bool is_simulated = false;  ///< may run on the virtual clock, and follows a trajectory
    bool is_moved_by_client = false;
    bool is_arm = false;  ///< it gives a force, and what it is may be measured
    /// Throws std::invalid_argument in one line for options that make no sense.
    std::function<PrepareDevice(const TypedOptions&)> checked{};
};

/// The first is the default.
const std::vector<DeviceEntry>& devices();

/// Throws std::invalid_argument for a name that is not there.
const DeviceEntry& find_device(const std::string& name);

/// Without a command line: an arm in a hand that follows the scene's trajectory; without a grip on rails.
DeviceParts simulated_hand(const Scene& scene, std::optional<Grip> grip, const ArmModel& arm = {});

DeviceEntry simulated_entry();
DeviceEntry client_entry();
DeviceEntry hid_entry();
DeviceEntry space_mouse_entry();
DeviceEntry bridge_entry();
DeviceEntry tracker_entry();
DeviceEntry haply_entry();

}  // namespace osteomill
