#include "tests/support/virtual_display.h"

#include <array>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace osteomill::testing {

namespace {

constexpr const char* xvfb = "/usr/bin/Xvfb";
constexpr const char* xdotool_program = "/usr/bin/xdotool";

/// A word of an XWD file's header (X11/XWDFile.h), most significant byte first.
std::size_t header_word(const std::vector<char>& bytes, std::size_t index) {
    std::size_t word = 0;
    for (std::size_t i = 0; i < 4; ++i)
        word = word << 8U | static_cast<unsigned char>(bytes.at(4 * index + i));
    return word;
}

}  // namespace

std::string VirtualDisplay::missing() {
    for (const char* program : {xvfb, xdotool_program})
        if (!std::filesystem::exists(program))
            return std::string(program) + " (apt-get install xvfb xdotool)";
    return {};
}

VirtualDisplay::VirtualDisplay(const glm::ivec2& size_px) {
    const std::string screen = std::to_string(size_px.x) + "x" + std::to_string(size_px.y) + "x24";
    server_.emplace(std::vector<std::string>{xvfb, "-displayfd", "1", "-screen", "0", screen, "-fbdir",
                                             folder_.path().string(), "-nolisten", "tcp", "-noreset"});
    const auto number = server_->line_after("");
    if (!number) throw std::runtime_error("Xvfb does not come up: " + server_->err());
    name_ = ":" + *number;
}

std::vector<std::string> VirtualDisplay::shown_here(std::vector<std::string> command) const {
    command.insert(command.begin(), {"/usr/bin/env", "-u", "WAYLAND_DISPLAY", "DISPLAY=" + name_});
    return command;
}

bool VirtualDisplay::xdotool(const std::vector<std::string>& arguments) const {
    std::vector<std::string> command{xdotool_program};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return run_program(shown_here(command)).status == 0;
}

Picture VirtualDisplay::screen() const {
    std::ifstream file(folder_ / "Xvfb_screen0", std::ios::binary);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    const std::size_t pixels = header_word(bytes, 0) + 12 * header_word(bytes, 19);
    const std::size_t bytes_per_line = header_word(bytes, 12);
    if (header_word(bytes, 1) != 7 || header_word(bytes, 11) != 32)
        throw std::runtime_error("Xvfb's screen is no XWD of 32 bits a pixel");
    Picture picture({static_cast<int>(header_word(bytes, 4)), static_cast<int>(header_word(bytes, 5))});
    std::size_t next = 0;
    for (int y = 0; y < picture.size_px.y; ++y)
        for (int x = 0; x < picture.size_px.x; ++x)
            for (const std::size_t channel : {2U, 1U, 0U})  // blue comes first
                picture.rgb[next++] =
                    static_cast<std::uint8_t>(bytes.at(pixels + static_cast<std::size_t>(y) * bytes_per_line +
                                                       4U * static_cast<std::size_t>(x) + channel));
    return picture;
}

}  // namespace osteomill::testing
