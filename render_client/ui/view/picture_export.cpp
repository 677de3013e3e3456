#include "render_client/ui/view/picture_export.h"

#include <fmt/format.h>

#include <stdexcept>

#include "render_client/volume/picture.h"

namespace osteomill {

namespace {

/// `name` followed by the lowest number, from 1, that nothing in the folder bears yet.
std::filesystem::path free_name(const std::filesystem::path& folder, const char* name, const char* ending) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw std::runtime_error(fmt::format("cannot make the folder {}", folder.string()));
    for (int number = 1;; ++number)
        if (const auto path = folder / fmt::format("{}_{:04}{}", name, number, ending);
            !std::filesystem::exists(std::filesystem::symlink_status(path)))
            return path;
}

}  // namespace

std::filesystem::path PictureExport::write(const Picture& picture) const {
    const std::filesystem::path file = free_name(folder_, "screenshot", ".png");
    write_png(picture, file);
    return file;
}

std::filesystem::path PictureExport::begin_frames() {
    const std::filesystem::path folder = free_name(folder_, "frames", "");
    std::error_code error;
    std::filesystem::create_directory(folder, error);
    if (error) throw std::runtime_error(fmt::format("cannot make the folder {}", folder.string()));
    frames_ = Frames{.folder = folder, .list = std::ofstream(folder / "frames.ffconcat")};
    frames_->list << "ffconcat version 1.0\n";
    return folder;
}

void PictureExport::add_frame(const Picture& picture, double now_s) {
    if (!frames_) return;
    try {
        const std::string name = fmt::format("frame_{:06}.png", ++frames_->count);
        if (frames_->count > 1) frames_->list << fmt::format("duration {:.4f}\n", now_s - frames_->last_s);
        frames_->last_s = now_s;
        write_png(picture, frames_->folder / name);
        frames_->list << "file " << name << "\n" << std::flush;
        if (!frames_->list) throw std::runtime_error("cannot write into " + frames_->folder.string());
    } catch (const std::runtime_error&) {
        frames_.reset();
        throw;
    }
}

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
