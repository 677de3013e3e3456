#include "simulation/loop/milling_sample.h"

#include <iterator>

namespace osteomill {

std::string MillingSample::header_line() {
    return "t_s,burr_x_mm,burr_y_mm,burr_z_mm,force_x_n,force_y_n,force_z_n,removed_mm3,spindle\n";
}

void MillingSample::append_to(fmt::memory_buffer& text) const {
    fmt::format_to(std::back_inserter(text), "{:.5f},{:.5f},{:.5f},{:.5f},{:.6f},{:.6f},{:.6f},{:.8f},{:d}\n",
                   time_s, burr_mm.x, burr_mm.y, burr_mm.z, force_n.x, force_n.y, force_n.z, removed_mm3,
                   spindle_on ? 1 : 0);
}

}  // namespace osteomill
