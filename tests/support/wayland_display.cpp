#include "tests/support/wayland_display.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tests/support/eventually.h"

namespace osteomill::testing {

namespace {

constexpr const char* weston = "/usr/bin/weston";
constexpr const char* socket_name = "wayland-test";

}  // namespace

std::string WaylandDisplay::missing() {
    if (!std::filesystem::exists(weston)) return std::string(weston) + " (apt-get install weston)";
    return VirtualDisplay::missing();
}

WaylandDisplay::WaylandDisplay(const glm::ivec2& size_px, int scale, Shell shell) : outside_(size_px) {
    std::filesystem::create_directory(folder_ / "none");
    // Its own panel, animations and blank screen would be in the way.
    std::ofstream(folder_ / "weston.ini")
        << "[core]\nidle-time=0\n[shell]\npanel-position=none\nlocking=false\n"
           "animation=none\nclose-animation=none\nstartup-animation=none\n"
           "background-color=0xff00ff00\n";
    compositor_.emplace(outside_.shown_here(
        {"/usr/bin/env", "XDG_RUNTIME_DIR=" + folder_.path().string(), weston, "--backend=x11-backend.so",
         "--use-pixman", "--width=" + std::to_string(size_px.x / scale),
         "--height=" + std::to_string(size_px.y / scale), "--scale=" + std::to_string(scale),
         shell == Shell::kiosk ? "--shell=kiosk-shell.so" : "--shell=desktop-shell.so",
         std::string("--socket=") + socket_name, "--config=" + (folder_ / "weston.ini").string(),
         "--log=" + (folder_ / "weston.log").string()}));
    if (!eventually([&] { return std::filesystem::exists(folder_ / socket_name); }))
        throw std::runtime_error("weston does not come up: " + compositor_->err());
}

std::vector<std::string> WaylandDisplay::shown_here(std::vector<std::string> command) const {
    command.insert(command.begin(), {"/usr/bin/env", "-u", "DISPLAY", "-u", "XDG_SESSION_TYPE",
                                     "XDG_RUNTIME_DIR=" + folder_.path().string(),
                                     std::string("WAYLAND_DISPLAY=") + socket_name});
    return command;
}

}  // namespace osteomill::testing
