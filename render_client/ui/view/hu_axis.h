// An axis of CT numbers for the client's stiffness: by the default relation (stiffness_relation.h), whatever
// relation the scene had.
#pragma once

namespace osteomill {

/// Relative stiffness at a CT number.
double stiffness_at_hu(double hu);

/// The lowest CT number, 0 to 4000 HU, of at least this relative stiffness; 4000 if none has it.
double hu_at_stiffness(double relative_stiffness);

}  // namespace osteomill
