#include "studies/stability/guided_work.h"

#include "studies/stability/energy_ledger.h"
#include "studies/stability/sampled_force.h"

namespace osteomill::study {

GuidedWork guided_work(std::span<const double> positions_m, double damping_n_s_per_m, const ModelForce& model,
                       const LinearHold& hold, double tick_s) {
    SampledForce force(model, hold, tick_s);
    EnergyLedger ledger;
    GuidedWork work;
    double position_m = 0.0;
    for (const double next_m : positions_m) {
        const double displacement_m = next_m - position_m;
        ledger.held(force(position_m), displacement_m);
        work.lost_in_damper_j += damping_n_s_per_m * displacement_m * displacement_m / tick_s;
        position_m = next_m;
    }
    work.taken_by_force_j = ledger.taken_j();
    return work;
}

}  // namespace osteomill::study
