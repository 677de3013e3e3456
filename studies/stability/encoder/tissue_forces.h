// Forces of each tissue of the tooth through each shipped arm, in newtons and in just noticeable differences.
//
// A hand tells two forces apart that differ by 7 % between 2.5 and 10 N (Pang, Tan and Durlach 1991, Percept
// Psychophys 49:531), by about 10 % between 2 and 5 N where one finger matches the other. Taken here is 10 %.
// Below 0.5 N no source was found: assumed is the 0.05 N that this makes there.
#pragma once

#include <filesystem>

#include "analysis/output/surroundings.h"

namespace osteomill::study {

/// How many just noticeable differences lie between two forces, newtons, neither below 0; negative where the
/// second is the smaller: the integral of dF over max(10 % F, 0.05 N).
double noticeable_differences(double from_n, double to_n);

/// Drills the cavity of the tooth scene with each arm in a tooth that is all of one tissue, a tissue after
/// the other: tissues.csv in `out`, a folder that is there. What is noticed is the
/// mean force over the arm's friction. Throws std::runtime_error in one line where a file cannot be written.
void run_tissue_study(const std::filesystem::path& out, const StudySurroundings& surroundings);

}  // namespace osteomill::study
