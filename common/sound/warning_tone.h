// The tone that warns of a protected structure, sample by sample: short pulses, which a burr's even note does
// not drown; twice a second if the burr is near, five times if it touches.
//
// A pulse has a fundamental of 880 Hz and the first harmonics, so that it is heard through a small
// loudspeaker and by those who no longer hear high notes (IEC 60601-1-8 asks alarms for 150 to 1000 Hz with
// four harmonics or more); it rises and falls in 10 ms, so that nothing clicks.
#pragma once

#include <cstdint>
#include <span>

#include "common/session/structure_distance.h"

namespace osteomill {

class WarningTone {
  public:
    static constexpr double fundamental_hz = 880.0;
    static constexpr double near_period_s = 0.5;
    static constexpr double touch_period_s = 0.2;
    static constexpr double pulse_s = 0.1;
    static constexpr double loudest = 0.3;
    /// It stops if no new state has come for so long.
    static constexpr double patience_s = 0.5;

    /// From the next sample on. A pulse that has begun ends first.
    void warn(StructureWarning warning) noexcept;
    /// Adds it to the next samples, of BurrSound's rate, which stay within -1 to 1.
    void add_to(std::span<float> samples) noexcept;
    bool is_silent() const noexcept { return warning_ == StructureWarning::none && in_period_s_ <= 0.0; }

  private:
    StructureWarning warning_ = StructureWarning::none;
    double unheard_s_ = 0.0;
    double in_period_s_ = 0.0;  // since the pulse began; 0: none has
};

}  // namespace osteomill
