#include "render_client/ui/view/screenshots.h"

#include <fmt/format.h>

#include "render_client/volume/png_file.h"

namespace osteomill {

Screenshots::Screenshots(std::filesystem::path folder, int every_frames)
    : folder_(std::move(folder)), every_frames_(every_frames) {
    if (!folder_.empty()) std::filesystem::create_directories(folder_);
}

void Screenshots::after_frame(const gl::Framebuffer& picture) {
    const bool is_due = is_next_due();
    ++frame_;
    if (!is_due) return;
    write_png(picture.read_back(), folder_ / fmt::format("frame_{:04}.png", frame_));
}

void Screenshots::after_last_frame(const gl::Framebuffer& picture) const {
    if (!folder_.empty()) write_png(picture.read_back(), folder_ / "final.png");
}

}  // namespace osteomill
