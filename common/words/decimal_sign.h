// Numbers as a person's language writes them: German ones with a decimal comma. Only for what people read:
// CSV, JSON and what a program reads again keep the point.
#pragma once

#include <string>

#include "common/words/translation.h"

namespace osteomill {

/// Every number of a text with the decimal sign of a language. Numbers with several points, such as versions,
/// stay as they are.
std::string with_decimal_sign(std::string text, const std::string& language = spoken_language());

}  // namespace osteomill
