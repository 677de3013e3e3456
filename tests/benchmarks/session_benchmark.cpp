// Sessions of the tooth on the virtual clock from C++, along a motion of a file; python_benchmark.py compares
// Python with them. The file holds doubles, seven a millisecond: the hand's position (mm, LPS), the spindle's
// axis, the pedal.
//
//     session_benchmark MOTION [REPEATS]      prints for each a line: ticks, CPU seconds to make it, CPU
//     seconds of its ticks, checksum
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <vector>

#include "devices/simulated/prescribed_device.h"
#include "haptic_server/session/session_assembly.h"

namespace {

using namespace osteomill;

struct Instant {
    glm::dvec3 position_mm;
    glm::dvec3 axis;
    double pedal;
};
static_assert(sizeof(Instant) == 7 * sizeof(double));

std::vector<Instant> read_motion(const char* file) {
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    std::vector<Instant> motion(static_cast<std::size_t>(in.tellg()) / sizeof(Instant));
    in.seekg(0);
    in.read(reinterpret_cast<char*>(motion.data()),
            static_cast<std::streamsize>(motion.size() * sizeof(Instant)));
    return motion;
}

double cpu_s() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void run(const SessionScene& loaded, const std::vector<Instant>& motion) {
    const double began_s = cpu_s();
    SessionScene scene = loaded;
    auto device = std::make_unique<PrescribedDevice>(scene.scene.start_pose, scene.scene.device);
    PrescribedDevice& hand = *device;
    DeviceParts parts;
    parts.device = std::move(device);
    SessionAssembly assembly(std::move(scene), std::move(parts),
                             {.milling = {.clock = ClockKind::virtual_time, .duration_s = 1e9}});
    assembly.start();
    assembly.advance(1);
    const double made_s = cpu_s();
    double sum_n = 0.0;
    for (const Instant& at : motion) {
        hand.move_to({at.position_mm, at.axis});
        hand.press(at.pedal != 0.0);
        assembly.advance(1);
        sum_n += assembly.session().newest_state().force_n.z;
    }
    const double done_s = cpu_s();
    assembly.end();
    fmt::print("{} {} {} {:016x} {}\n", motion.size(), made_s - began_s, done_s - made_s,
               checksum(assembly.session().bone()), sum_n);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) return 2;
    const std::vector<Instant> motion = read_motion(argv[1]);
    const SessionScene loaded = load_session_scene({.name = "tooth"});
    for (int i = 0; i < (argc > 2 ? std::atoi(argv[2]) : 1); ++i) run(loaded, motion);
}
