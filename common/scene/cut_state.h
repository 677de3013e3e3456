// State of the cut of a burr's edges, in few numbers: the force within the tooth period, for the sound of the
// cut. The felt force does not depend on it.
#pragma once

#include <optional>

namespace osteomill {

struct CutState {
    double force_n = 0.0;  ///< of the bone on the burr, mean over the last tooth periods
    /// Amplitude of that force's first harmonic of the tooth period; 0 if the force model has no edges.
    double tooth_ripple_n = 0.0;
    double relative_stiffness = 1.0;  ///< of the bone in front of the edges; 1: cortical bone
    /// Speed of the spindle under the load. Nothing if the scene has no motor.
    std::optional<double> loaded_rpm{};

    bool operator==(const CutState&) const = default;
};

}  // namespace osteomill
