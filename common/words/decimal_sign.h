// Numbers as a person's language writes them: German ones with a decimal comma. Only for what people read:
// CSV, JSON and what a program reads again keep the point.
#pragma once

#include <string>

namespace osteomill {

/// Every number of a text with the decimal sign of the chosen language. Numbers with several points, such as
/// versions, stay as they are.
std::string with_decimal_sign(std::string text);

}  // namespace osteomill
