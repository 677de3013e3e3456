#include "render_client/ui/panels/scale_bar.h"

#include <fmt/format.h>

#include "render_client/ui/panels/round_number.h"

namespace osteomill {

ScaleBar scale_bar(double mm_per_px, double longest_px) {
    const double length_mm = round_number_up_to(mm_per_px * longest_px);
    const std::string label =
        length_mm < 0.999 ? fmt::format("{:g} um", 1e3 * length_mm) : fmt::format("{:g} mm", length_mm);
    return {length_mm, length_mm / mm_per_px, label};
}

}  // namespace osteomill
