// Estimates from the ticks of a measured arm: steps and noise of its readings; mass, damping, stiffness and
// friction of arm and hand.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace osteomill {

/// One tick of an arm that is measured. Device space.
struct MeasuredTick {
    glm::dvec3 position_mm{0.0};  ///< as it was read
    glm::dvec3 force_n{0.0};      ///< as it was written then, for the tick that follows
};

/// A tick is a millisecond, for all that measures here.
inline constexpr double measuring_tick_s = 0.001;

/// Ticks in their order, in memory that is there from the start. Ticks that were missed are filled in: the
/// force was held, and the reading is the next one's.
class TickRecord {
  public:
    explicit TickRecord(std::size_t most) { ticks_.reserve(most); }

    /// Real-time safe. Past the most, ticks are dropped.
    void add(const glm::dvec3& position_mm, const glm::dvec3& force_n, std::size_t missed) noexcept {
        const glm::dvec3 held_n = ticks_.empty() ? glm::dvec3(0.0) : ticks_.back().force_n;
        for (std::size_t i = 0; i < missed && ticks_.size() < ticks_.capacity(); ++i)
            ticks_.push_back({position_mm, held_n});
        if (ticks_.size() < ticks_.capacity()) ticks_.push_back({position_mm, force_n});
    }

    std::size_t size() const noexcept { return ticks_.size(); }
    /// The ticks from `begin` on.
    std::span<const MeasuredTick> from(std::size_t begin) const noexcept {
        return std::span(ticks_).subspan(begin < ticks_.size() ? begin : ticks_.size());
    }

  private:
    std::vector<MeasuredTick> ticks_;
};

// The step of an arm's encoders, and the noise of its readings, from readings alone.
//
// Step. An encoder that moves slowly changes now and then by one count, and between such changes the reading
// stays to the bit. So a change with none in the two ticks before and after it is one count of one encoder,
// and its length one step at the tip. The step is the length below which 40 % of these lie: now and then two
// encoders count in the same tick. If noise is larger than a step, no change stands alone; then the readings
// of an axis still lie on a lattice, and the step is the length below which a tenth of the changes lie. If
// readings hardly ever repeat, no step is seen.
//
// Noise, rms of an axis. The second difference of white noise of deviation s has the variance 6 s^2, while a
// hand at 10 Hz and 0.1 mm leaves 0.0004 mm in it (Allan's way of telling noise from drift, Proc. IEEE
// 54:221, 1966). Taken in windows of 50 ms, of which the quietest quarter counts: there the hand crosses the
// fewest steps.

/// Over ticks in which the arm moves, or is moved; mm. 0: no step was seen. Not real-time safe.
double encoder_step_mm(std::span<const MeasuredTick> ticks);

/// Over ticks of a hand that rests, at least 50; mm, the noisiest axis. Not real-time safe.
double reading_noise_mm(std::span<const MeasuredTick> at_rest);

/// Mass, damping, stiffness and friction of arm and hand when the arm pushes along one axis, and the delay of
/// the force.
///
///     m x'' + b x' + k x + c + F_c sgn(x') = u(t - d)     u the written force, held from tick to tick
///
/// Multiplied by a smooth bump that is zero with three derivatives at the ends of a window of 60 ms, and
/// integrated by parts, the derivatives fall on the bump, and no reading is ever differentiated (Shinbrot,
/// Trans. ASME 79:547, 1957; Preisig and Rippin, Computers chem. Engng 17:1, 1993):
///
///     m int x w'' - b int x w' + k int x w + c int w + F_c int sgn(x') w = int u(t - d) w
///
/// A window every 5 ms gives a line each; m, b, k, c, F_c are the least squares' solution. The delay d is the
/// one at which what is left over is least, of 0 to 12 ms by 0.1. The sign of x' is a smooth one, of the
/// motion over 8 ms.
struct PushedMotion {
    double mass_kg = 0.0;      ///< of the arm and the part of the hand that moves with it
    double friction_n = 0.0;   ///< Coulomb's
    double delay_ticks = 0.0;  ///< beyond the tick in which a written force begins to act
    double explained = 0.0;    ///< share of the force's variance, 0 to 1
};

/// The motion in ticks in which the arm pushed along `axis`, 0 to 2, with readings in steps of `step_mm` (0:
/// none to speak of). Nothing if the arm hardly moved, or moved in another way than it was pushed. Not
/// real-time safe.
std::optional<PushedMotion> pushed_motion(std::span<const MeasuredTick> ticks, std::size_t axis,
                                          double step_mm);

}  // namespace osteomill
