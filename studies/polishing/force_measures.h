// Numbers that a record of force is judged by.
#pragma once

#include <optional>
#include <vector>

#include "studies/polishing/force_record.h"

namespace osteomill::study {

/// A stretch of a record.
struct ForceWindow {
    double depth_mm = 0.0;    ///< mean
    double fast_rms_n = 0.0;  ///< of the force about its own slow part
};

/// A hand that follows its motion changes the force within tenths of a second; the limit cycles of sampled
/// contact go at 10 Hz (a firm hand at 100 Hz milling) and above. The slow part of a force is its mean over
/// 0.1 s about each moment: what goes at 10 Hz and faster is left out of it entirely or nearly so.
inline constexpr double slow_part_s = 0.1;

/// The record in windows of `window_s`; the last, if shorter, is left out. Samples are taken to be evenly
/// spaced. Within half of slow_part_s from either end the slow part is the mean of what there is.
std::vector<ForceWindow> windows_of(const ForceRecord& record, double window_s);

/// Amplitude of the limit cycle: the value of fast_rms_n that nine tenths of the windows stay below. Not the
/// largest, because where a stroke turns round or a new pass begins the force rightly changes fast. 0 without
/// windows.
double limit_cycle_n(const std::vector<ForceWindow>& windows);

/// A limit cycle of this rms or more is chatter. Two encoder steps of the arm, 0.055 mm, rendered by the
/// stiffest spring that it can, 1.5 N/mm, are 0.17 N: what is smaller may be the sensor's grain, and hides
/// behind the arm's friction of 0.26 N.
inline constexpr double chatter_n = 0.2;

/// Depth at which chatter begins: of the first window that is followed by another one with fast_rms_n above
/// chatter_n and has it, too. nullopt: nowhere.
std::optional<double> onset_of_chatter_mm(const std::vector<ForceWindow>& windows);

/// Mean length of the force, N; 0 for an empty record.
double mean_force_n(const ForceRecord& record);
}  // namespace osteomill::study
