#include "simulation/loop/force_sample.h"

#include <iterator>

namespace osteomill {

void ForceSample::append_to(fmt::memory_buffer& text) const {
    fmt::format_to(std::back_inserter(text),
                   "{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.5f},{:.5f},{:.5f},{:.4f},{:.5f},{:d},"
                   "{:d}",
                   time_s, hand_mm.x, hand_mm.y, hand_mm.z, burr_mm.x, burr_mm.y, burr_mm.z, force_n.x,
                   force_n.y, force_n.z, depth_mm, removed_mm3, spindle_on ? 1 : 0, static_cast<int>(fault));
    if (shank_torque_n_mm)
        fmt::format_to(std::back_inserter(text), ",{:.4f},{:.4f},{:.4f}", shank_torque_n_mm->x,
                       shank_torque_n_mm->y, shank_torque_n_mm->z);
    text.push_back('\n');
}

}  // namespace osteomill
