// A rating as people read it on a report: the score with the amount undone for it, and the table of its
// items.
#pragma once

#include <string>

#include "analysis/report/rating_result.h"
#include "analysis/report/session_trace.h"

namespace osteomill {

/// "14 of 20 points", which items are missed, and how often and how much was undone. Empty if the session has
/// no rating; if it has one and the recording is not complete, it says so.
std::string rating_summary(const SessionTrace& trace, const RatingResult& rating);

/// A heading, and a line for each item: whether it is reached, its condition, the measured values, its
/// source. Empty without items.
std::string rating_table(const RatingResult& rating);

}  // namespace osteomill
