// Defaults of a session: its coupling and the rate of its milling loop.
#pragma once

#include <string>

#include "haptic_server/session/device_table.h"
#include "simulation/coupling/couplings.h"

namespace osteomill {

/// The coupling that the device asks for; else the default one, which solves the cutting law, and
/// `interpolate` with a force model that has none.
CouplingChoice usual_coupling(bool has_cutting_law, const DeviceEntry& device);

/// The published rate is 100 Hz for the milling force. A contact model, whose force is also the wall, needs
/// the full rate: an arm in a light hand holds 0.2 N/mm at 100 Hz, 1.4 N/mm at 1 kHz. Throws
/// std::invalid_argument for an unknown force model.
double usual_milling_rate_hz(const CouplingChoice& coupling, const std::string& force_model);

}  // namespace osteomill
