#include "imaging/bone_file/removed_volumes.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <sstream>

#include "imaging/imaging_error.h"

namespace osteomill {

std::string text_of_removed(const VolumesByTissue& removed_mm3) {
    // Differences of large sums leave rounding, which is no bone.
    constexpr double least_mm3 = 1e-9;
    std::string text;
    for (std::size_t label = 0; label < removed_mm3.size(); ++label)
        if (removed_mm3[label] > least_mm3)
            fmt::format_to(std::back_inserter(text), "{}{}:{:.9f}", text.empty() ? "" : " ", label,
                           removed_mm3[label]);
    return text;
}

VolumesByTissue removed_before_mm3(const BoneFile& file) {
    VolumesByTissue removed_mm3{};
    const auto found = file.key_values().find(removed_key);
    if (found == file.key_values().end()) return removed_mm3;
    std::istringstream text(found->second);
    while (!(text >> std::ws).eof()) {
        std::size_t label = 0;
        char colon = ' ';
        double mm3 = 0.0;
        text >> label >> colon >> mm3;
        if (text.fail() || colon != ':' || label >= removed_mm3.size() || !std::isfinite(mm3) || mm3 < 0.0)
            throw ImagingError(file.path(), fmt::format("damaged: {}:={} is no list of LABEL:MM3",
                                                        removed_key, found->second));
        removed_mm3[label] = mm3;
    }
    return removed_mm3;
}

}  // namespace osteomill
