// Pictures that the user asks for: one at a time, or every frame while they come.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>

#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/picture.h"

namespace osteomill {

/// Writes into `folder`, which is made with the first picture. Existing files are not overwritten.
class PictureExport {
  public:
    explicit PictureExport(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// Writes screenshot_0001.png or the next free number; the file. Throws std::runtime_error if it
    /// cannot.
    std::filesystem::path write(const Picture& picture) const;

    /// Begins frames_0001 or the next free number; the folder. Throws std::runtime_error if it cannot.
    std::filesystem::path begin_frames();
    void end_frames() { frames_.reset(); }
    bool is_exporting() const { return frames_.has_value(); }
    /// The next frame, shown `now_s` (a clock that goes on) until the one after it. Frames come when they are
    /// drawn, so their times go into frames.ffconcat, which ffmpeg makes a video of the right speed from.
    /// Throws std::runtime_error if it cannot write, and ends the export.
    void add_frame(const Picture& picture, double now_s);

  private:
    struct Frames {
        std::filesystem::path folder;
        std::ofstream list;
        int count = 0;
        double last_s = 0.0;
    };

    std::filesystem::path folder_;
    std::optional<Frames> frames_;
};

/// Pictures of a run, written as it goes: every so many frames one, and the last.
class Screenshots {
  public:
    /// Creates the folder; an empty one means that nothing is written. Throws
    /// std::filesystem::filesystem_error.
    Screenshots(std::filesystem::path folder, int every_frames);

    /// Whether the next after_frame() writes a picture.
    bool is_next_due() const { return !folder_.empty() && (frame_ + 1) % every_frames_ == 0; }
    /// Writes frame_0001.png and so on if this frame is due.
    void after_frame(const gl::Framebuffer& picture);
    /// Writes final.png.
    void after_last_frame(const gl::Framebuffer& picture) const;

  private:
    std::filesystem::path folder_;
    int every_frames_;
    int frame_ = 0;
};

}  // namespace osteomill
