#include "render_client/ui/view/screenshots.h"

#include <fmt/format.h>

#include "render_client/volume/png_file.h"

namespace osteomill {

Screenshots::Screenshots(std::filesystem::path folder, int every_frames)
    : folder_(std::move(folder)), every_frames_(every_frames) {
    if (!folder_.empty()) std::filesystem::create_directories(folder_);
}

void Screenshots::after_frame(const gl::Framebuffer& picture) {
    ++frame_;
    if (folder_.empty() || frame_ % every_frames_ != 0) return;
    write_png(picture.read_back(), folder_ / fmt::format("frame_{:04}.png", frame_));
}

void Screenshots::after_last_frame(const gl::Framebuffer& picture) const {
    if (!folder_.empty()) write_png(picture.read_back(), folder_ / "final.png");
}

}  // namespace osteomill
