// A rating's condition (common/scene/rating_condition.h) in a person's words: "share of the plan removed ≥ 50
// % and touches (Facial Nerve) = 0" for "plan_removed_share >= 0.5 and structure_touches('Facial_Nerve') ==
// 0".
#pragma once

#include <string>
#include <string_view>

#include "analysis/report/page_style.h"

namespace osteomill {

/// A quantity by its key and the name of its tissue or burr, which may be empty: "touches (Facial Nerve)".
std::string quantity_text(std::string_view key, const std::string& of);

/// Its value with its unit, as people read it: shares in percent.
ShownValue quantity_value(std::string_view key, double value);

/// In the chosen language. Numbers that are compared with one quantity have its unit. The condition as it
/// stands if it cannot be read.
std::string condition_text(const std::string& condition);

}  // namespace osteomill
