// The sound of a burr, sample by sample, as a microphone beside the handpiece would hear it. Four parts:
//
// - Tooth note, the force within the tooth period: a row of harmonics of edges * revolutions, each r times
//   the one below, with r = ripple / (2 force), as of a train of pulses (Poisson's kernel). Louder with the
//   force; run-out lets it beat once a turn.
// - Whine of the spindle in air, at its revolutions, and the edges in the air, faint; a cut drowns it.
// - Grain, noise of the chips, in a band that follows the tissue: dark in soft bone, bright in enamel.
// - Growl of a motor that is held, at mains' pitch; all that is left of a stall.
//
// The spindle runs up, slows down and coasts as a motor does, and everything else follows its cue within some
// hundredths of a second, so that cues thirty times a second make no clicks. Nothing sounds above 20 kHz: a
// harmonic that would, is left out. Loudness is taste, not measurement: it rises with the logarithm of the
// force, and high notes are softer, since an ear is keenest there.
//
// The same cues give the same samples. Noise comes from a generator that starts alike each time.
#pragma once

#include <cstdint>
#include <span>

#include "common/session/tool_state.h"

namespace osteomill {

/// Cues for the sound of a tool: which notes its spindle makes, and how hard it works.
struct SoundCue {
    double rev_per_s = 0.0;           ///< the spindle under its load; 0: it stands
    int edges = 6;                    ///< the burr's edges: edges * rev_per_s is the note of the cut
    double force_n = 0.0;             ///< the cut's force, mean over a tooth period; 0: it turns in air
    double tooth_ripple_n = 0.0;      ///< amplitude of the force within the tooth period
    double relative_stiffness = 1.0;  ///< the stiffness of the bone that is cut; 1: cortical bone
    double strain = 0.0;              ///< the share of the speed that the load took: 1 is a stall
};

/// `burr`: the tool's. A number that is not finite or out of range is replaced by the nearest valid one, so
/// that hostile data makes no unpleasant sound.
SoundCue cue_of(const ToolState& tool, const Burr& burr) noexcept;

class BurrSound {
  public:
    static constexpr int rate_hz = 48'000;
    /// A tool without a new state for so long is taken to stand.
    static constexpr double patience_s = 0.5;

    /// From the next sample on.
    void hear(const SoundCue& cue) noexcept;
    /// The next samples, -1 to 1. Does not allocate.
    void render(std::span<float> samples) noexcept;

    /// Neither sounding nor about to: render() gives zeros until it hears of a spindle that turns.
    bool is_silent() const noexcept { return !is_wanted() && rev_per_s_ == 0.0; }

  private:
    /// Two-pole band-pass whose middle may move from sample to sample (Zavalishin's state variable filter).
    class Band {
      public:
        void tune(double middle_hz) noexcept;
        double pass(double in) noexcept;

      private:
        double g_ = 0.1;
        double a_ = 0.0;
        double b_ = 0.0;
    };

    /// The quantities of a cue that an ear hears; all move towards the newest cue's.
    struct Heard {
        double load = 0.0;   // loudness of the force, 0 to 1
        double tooth = 0.0;  // loudness of the tooth note: an even force has less of it
        double fall = 0.0;   // r, from harmonic to harmonic
        double strain = 0.0;
        double grain_hz = 1000.0;
    };

    /// Whether the cue's spindle turns, or would if its load let it.
    bool is_wanted() const noexcept { return cue_.rev_per_s > 0.0 || cue_.strain > 0.0; }
    Heard heard_of(const SoundCue& cue) const noexcept;
    bool has_come_to_rest() const noexcept;
    void follow() noexcept;
    void turn() noexcept;
    double tooth_note() const noexcept;
    double white() noexcept;
    double next_sample() noexcept;

    SoundCue cue_;
    double unheard_s_ = 0.0;  // since the cue

    Heard wanted_;
    Heard heard_;
    double rev_per_s_ = 0.0;
    double flutter_ = 0.0;  // slow noise: no hand and no bone is even

    double turned_rev_ = 0.0;    // within a turn
    double tooth_turned_ = 0.0;  // within a tooth period
    double growl_turned_ = 0.0;
    std::uint32_t noise_ = 0x9E3779B9u;
    int samples_to_tuning_ = 0;
    Band grain_;
};

}  // namespace osteomill
