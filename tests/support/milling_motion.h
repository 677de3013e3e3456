// A motion that mills block_file.h's block for five minutes, whatever the machine does meanwhile.
#pragma once

#include <filesystem>
#include <fstream>

namespace osteomill::testing {

/// A stroke every two seconds, each a little farther and deeper, with the burr lifted clear of the bone
/// between them. If a busy machine makes the loops late, the force goes off, and a burr that has sunk into
/// bone by then stays without force and spindle until it is held clear.
inline void write_milling_motion(const std::filesystem::path& csv) {
    std::ofstream out(csv);
    out << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n";
    constexpr int strokes = 150;
    for (int stroke = 0; stroke < strokes; ++stroke) {
        const double share = static_cast<double>(stroke) / strokes;
        const auto put = [&](double after_s, double z_mm, int pedal) {
            out << 2.0 * stroke + after_s << ',' << 6.0 * share - 3.0 << ",0," << z_mm << ",0,0,1," << pedal
                << '\n';
        };
        put(0.0, 5.0, 0);
        put(0.3, 5.0, 0);
        put(0.6, 2.5, 1);
        put(1.0, 1.5 - 0.5 * share, 1);
        put(1.7, 1.5 - 0.5 * share, 1);
    }
}

}  // namespace osteomill::testing
