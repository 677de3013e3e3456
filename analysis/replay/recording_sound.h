// Sound of a recording, as a WAV file: mono, 48 kHz, 16 bits; the same recording makes the same
// bytes.
#pragma once

#include <sndfile.h>

#include <filesystem>
#include <memory>

#include "common/files/atomic_file.h"
#include "common/recording/playhead.h"
#include "common/sound/burr_sound.h"

namespace osteomill {

class RecordingSound {
  public:
    /// 12 hours; a WAV file holds 4 GiB.
    static constexpr double longest_s = 12.0 * 3600.0;

    /// Throws std::runtime_error if the file cannot be written.
    explicit RecordingSound(const std::filesystem::path& file);
    /// The sound up to this state; from there on the tool is as it says. Throws std::runtime_error if the
    /// sound cannot be written or grows too long.
    void add(const Playhead& playhead);
    /// Makes it the file, which is as it was until then. Throws std::runtime_error if that fails.
    void close();

  private:
    struct Closing {
        void operator()(SNDFILE* file) const { sf_close(file); }
    };
    void render_until(double time_s);
    void hear(const ToolState& tool, const Playhead& playhead);
    [[noreturn]] void fail(const std::string& why) const;

    AtomicFile file_;
    std::unique_ptr<SNDFILE, Closing> out_;
    BurrSound sound_;
    ToolState heard_;
    std::int64_t written_ = 0;  // samples
};

}  // namespace osteomill
