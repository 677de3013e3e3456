// A sampled motion, played at the haptic loop's rate: smooth, without a gap, and never beyond the measured
// positions.
//
// Samples carry the time of their sender's clock and arrive late, now more, now less. They are played back by
// that clock with a delay of two sample periods and the lateness that was seen lately:
//
//     offset   = least of (arrival - stamp), with room for clocks that drift by 1 ms/s
//     lateness = most of (arrival - stamp - offset), forgotten with a time constant of 20 s
//     delay    = 2 periods + 1.1 lateness;    period: the median of the last differences of stamps
//
// Between samples i and i + 1 the position is the cubic with their positions and, as slopes there, those of
// the parabolas through each and its neighbours (Catmull-Rom, for uneven times); the orientation is slerp.
// The slopes need one sample more than those two, hence the second period. On a circle of 2 mm, once a
// second, sampled at 20 Hz, the cubic is off by 0.5 um; straight lines would be off by 25. Slopes are no
// steeper than a hand is fast, and the cubic stays within most_bulge_mm of the straight line: the burr never
// goes far from a sample.
//
// Samples less than least_apart_s apart count as one, the first: the difference is the tracker's noise, not
// motion. A sample that a hand cannot have reached is skipped; if the next confirms it, the marker really is
// elsewhere (it was hidden, or confused with another), and the motion restarts there.
//
// Playback never jumps: if the next sample is late it stops at the last but one, and then runs at most
// catch_up times as fast until it is on time again. So the burr's path is the same, sample by sample,
// whatever the link does.
//
// Playback needs three samples. It ends when none has come for five periods (50 ms at least, 250 ms at most):
// the tool is lost, and the next sample starts anew. A clock that was set has the same effect.
//
// The sender's clock is trusted only as far as ours bears it out: it may run fast, slow, jump, stand or wrap,
// and a link may delay messages more and more. More than longest_behind_s behind the delay, the tool is lost,
// for as long as that lasts:
//
//     ahead    the clock gained more on ours lately than longest_behind_s (it runs fast, or jumped), or
//              playback cannot keep up with it
//     behind   the newest sample is later than longest_delay_s can hide by more than longest_behind_s: its
//              clock runs slow, or what comes grows old on the way
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace osteomill {

class SampledMotion {
  public:
    static constexpr double fastest_rate_hz = 500.0;
    static constexpr double slowest_rate_hz = 20.0;
    static constexpr double longest_delay_s = 0.4;
    static constexpr double longest_behind_s = 0.05;
    static constexpr double catch_up = 1.5;
    static constexpr double least_silence_s = 0.05;
    static constexpr double most_silence_s = 0.25;
    /// Half a period at the fastest rate.
    static constexpr double least_apart_s = 0.5 / fastest_rate_hz;
    /// Half a voxel of 0.1 mm.
    static constexpr double most_bulge_mm = 0.05;
    /// Two samples may be so much farther apart than at fastest_hand_mm_per_s: noise, and a long lever from
    /// marker to burr.
    static constexpr double noise_mm = 1.0;
    /// A wrist that flicks; and the noise of a small marker.
    static constexpr double fastest_turn_rad_per_s = 20.0;
    static constexpr double turn_noise_rad = 0.1;

    struct Sample {
        double stamp_s = 0.0;    ///< the sender's clock; 0: it has none, and the arrival stands for it
        double arrival_s = 0.0;  ///< when the loop took it
        glm::dvec3 position_mm{0.0};
        glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    };
    struct Pose {
        glm::dvec3 position_mm{0.0};
        glm::dvec3 velocity_mm_per_s{0.0};
        glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    };

    /// Why the tool is lost though samples come.
    enum class ClockFault : std::uint8_t { none, ahead, behind };

    /// One more sample. One that is no newer than the last by least_apart_s does nothing. Real-time safe, as
    /// all here.
    void take(Sample sample) noexcept;

    /// The tool's pose at `now_s` (the clock of arrival_s; never decreases); nothing while it is lost.
    std::optional<Pose> at(double now_s) noexcept;

    /// The playback's delay behind the samples' clock at the last at(): a hand waits so long for its picture.
    double delay_s() const noexcept { return delay_s_; }
    double period_s() const noexcept { return period_s_; }
    /// At the last at().
    ClockFault clock_fault() const noexcept { return clock_fault_; }

  private:
    static constexpr std::size_t most_samples = 512;  // over a second at 500 Hz
    static constexpr std::size_t period_samples = 15;

    const Sample& nth(std::size_t i) const noexcept { return samples_[(first_ + i) % most_samples]; }
    const Sample& newest() const noexcept { return nth(count_ - 1); }
    void begin_anew() noexcept;
    bool was_set(const Sample& sample) const noexcept;
    /// The verdict that the samples' times give.
    ClockFault judge_clock() const noexcept;
    void learn_period(double difference_s) noexcept;
    void learn_lateness(const Sample& sample, double since_last_s) noexcept;
    void keep(const Sample& sample) noexcept;
    Pose pose_between(std::size_t i, double time_s) const noexcept;
    glm::dvec3 slope(std::size_t i) const noexcept;

    std::array<Sample, most_samples> samples_{};
    std::size_t first_ = 0;
    std::size_t count_ = 0;
    std::optional<Sample> last_;     // the newest that was kept, also where it no longer counts
    std::optional<Sample> outlier_;  // the newest sample, where no hand can have reached it
    std::array<double, period_samples> differences_s_{};
    std::size_t differences_ = 0;
    double period_s_ = 1.0 / slowest_rate_hz;
    double offset_s_ = 0.0;    // the loop's clock less the sender's
    double lateness_s_ = 0.0;  // most of it
    double gained_s_ = 0.0;    // by the sender's clock on the loop's, lately
    ClockFault clock_fault_ = ClockFault::none;
    double delay_s_ = 0.0;
    double played_s_ = 0.0;  // the sender's clock
    double at_s_ = 0.0;      // the last at()
    bool plays_ = false;
};

}  // namespace osteomill
