#include "imaging/formats/length_unit.h"

#include <array>
#include <string_view>

#include "common/text/words.h"

namespace osteomill {

namespace {

struct LengthUnit {
    double mm;
    std::array<std::string_view, 7> names;  ///< in lower case, without the s of a plural
};
// Micro is U+00B5, U+03BC or, in Latin-1, the byte B5.
constexpr std::array length_units{
    LengthUnit{1.0, {"mm", "millimeter", "millimetre"}}, LengthUnit{10.0, {"cm", "centimeter", "centimetre"}},
    LengthUnit{1000.0, {"m", "meter", "metre"}},
    LengthUnit{1e-3, {"um", "\xc2\xb5m", "\xce\xbcm", "\xb5m", "micron", "micrometer", "micrometre"}},
    LengthUnit{1e-6, {"nm", "nanometer", "nanometre"}}};

std::string usual(const std::string& name) {
    return lower_case(trimmed(name));
}

}  // namespace

std::optional<double> mm_of_unit(const std::string& name) {
    const std::string asked = usual(name);
    const std::string singular = asked.ends_with('s') ? asked.substr(0, asked.size() - 1) : asked;
    for (const LengthUnit& unit : length_units)
        for (const std::string_view known : unit.names)
            if (!known.empty() && (asked == known || (known.size() > 3 && singular == known))) return unit.mm;
    return std::nullopt;
}

bool is_unknown_unit(const std::string& name) {
    const std::string asked = usual(name);
    return asked.find_first_not_of('?') == std::string::npos || asked == "none" || asked == "unknown";
}

}  // namespace osteomill
