#include "haptic_server/session/session_defaults.h"

#include "simulation/force_models/force_models.h"
#include "simulation/loop/milling_session.h"

namespace osteomill {

CouplingChoice usual_coupling(bool has_cutting_law, const DeviceEntry& device) {
    if (device.coupling) return {*device.coupling};
    return has_cutting_law ? CouplingChoice() : CouplingChoice{CouplingKind::interpolate};
}

double usual_milling_rate_hz(const CouplingChoice& coupling, const std::string& force_model) {
    const double published_rate_hz = 100.0;
    const bool is_as_published =
        entry_of(coupling.kind).is_interpolated && find_force_model(force_model).has_cutting_law;
    return is_as_published ? published_rate_hz : 1.0 / MillingSession::tick_s;
}

}  // namespace osteomill
