// Pictures of a run, written as it goes: every so many frames one, and the last.
#pragma once

#include <filesystem>

#include "render_client/volume/gl/framebuffer.h"

namespace osteomill {

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
