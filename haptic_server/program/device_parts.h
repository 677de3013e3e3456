// The device that moves the tool, as the command line asks for it.
#pragma once

#include <atomic>
#include <memory>

#include "bridge/osteomill_bridge.h"
#include "common/log/line_stream.h"
#include "devices/hid/hid_transport.h"
#include "devices/simulated/simulated_device.h"
#include "haptic_server/program/server_options.h"
#include "simulation/device/haptic_device.h"
#include "simulation/exchange/operator_channel.h"

namespace osteomill {

/// The device, and what it is driven by.
struct DeviceParts {
    std::unique_ptr<HidTransport> transport;            // null: the device is not plugged in
    std::unique_ptr<OperatorChannel> operator_channel;  // null: nobody may drive
    std::unique_ptr<HapticDevice> device;
    const SimulatedDevice* simulated = nullptr;  // `device`, if it is one

    bool is_finished() const { return simulated != nullptr && simulated->is_finished(); }
};

/// Of --bridge-key; none where it is not given. Apart, for a wrong one to be told before a bone is loaded.
/// Throws std::runtime_error in one line.
omb_key read_bridge_key(const ServerOptions& options);

/// Places the scene, too, where it leaves that to the device. Says in `out` what it waits for: an arm behind
/// the bridge that has not joined. No device where `stop` came first. Throws std::runtime_error in one line.
DeviceParts make_device(const ServerOptions& options, const omb_key& bridge_key, Scene& scene,
                        const std::atomic<bool>& stop, LineStream& out);

}  // namespace osteomill
