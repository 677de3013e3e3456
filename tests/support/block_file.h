// A small block of bone in a file, for programs: there in no time.
#pragma once

#include <filesystem>
#include <fstream>
#include <random>

namespace osteomill::testing {

/// 9.6 x 8 x 6.4 mm round the origin, ever stiffer upwards; with a grain of up to so many HU, at random.
inline void write_block(const std::filesystem::path& nrrd, int grain_hu = 0) {
    std::ofstream out(nrrd, std::ios::binary);
    out << "NRRD0004\ntype: int16\ndimension: 3\nspace: left-posterior-superior\nsizes: 48 40 32\n"
           "space directions: (0.2,0,0) (0,0.2,0) (0,0,0.2)\nspace origin: (-4.7,-3.9,-4.1)\n"
           "encoding: raw\nendian: little\n\n";
    std::mt19937 random(1);
    for (int z = 0; z < 32; ++z)
        for (int voxel = 0; voxel < 48 * 40; ++voxel) {
            const int grain =
                grain_hu == 0 ? 0 : static_cast<int>(random() % static_cast<unsigned>(grain_hu));
            const int hu = 400 + 30 * z + grain;
            out.put(static_cast<char>(hu & 0xFF)).put(static_cast<char>(hu >> 8));
        }
}

}  // namespace osteomill::testing
