// A recording in place of a server, for the UI thread: plays, pauses, goes to any time, back as well, by
// key frames.
//
// Going forward applies the recorded frames; going back takes up the last key frame before (see KeyFrames)
// and goes forward from there. A long way takes several polls, so that a window never stands still.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "common/bone/bone.h"
#include "common/recording/playhead.h"
#include "common/recording/recording_reader.h"
#include "common/wire/zstd_compressor.h"
#include "render_client/link/link_meters.h"
#include "render_client/link/session_source.h"

namespace osteomill {

/// Key frames of a bone that is being milled, so that a recording can be wound back without reading it from
/// its beginning.
///
/// A key frame holds only the bricks that changed since the one before, compressed; a brick that nothing has
/// changed yet is held nowhere. The memory is that of the bone that was milled, not of the bone.
class KeyFrames {
  public:
    /// Recorded time between two key frames: winding back reads at most so much again.
    static constexpr double interval_s = 5.0;

    /// `start`: where the bone is as it first came.
    explicit KeyFrames(Playhead::Mark start);

    /// Before the playhead takes its next frame: saves the bricks that it will change.
    void before_step(const Playhead& playhead);
    /// Behind a frame: makes a key frame if it is time for one. Key frames that exist already are not made
    /// again.
    void after_step(const Playhead& playhead);

    /// Takes the playhead back to the last key frame that is not later than `time_s`; the bone changes where
    /// it differs from the key frame's.
    void wind_back(Playhead& playhead, double time_s) const;

    std::size_t memory_bytes() const { return memory_bytes_; }

  private:
    struct Version {
        std::size_t key = 0;  // index in marks_
        std::vector<std::uint8_t> compressed;
    };
    void keep(BrickIndex brick, BrickFractions fractions, std::size_t key);

    std::vector<Playhead::Mark> marks_;                    // ascending in time
    std::map<BrickIndex, std::vector<Version>> versions_;  // ascending in key
    std::set<BrickIndex> changed_;                         // since the last key frame
    std::size_t memory_bytes_ = 0;
    ZstdCompressor compressor_;
};

/// Nobody can drive it.
class RecordingPlayer final : public SessionSource {
  public:
    using Time = std::chrono::steady_clock::time_point;

    static constexpr double slowest = 0.1;
    static constexpr double fastest = 100.0;

    /// Reads the first bone and begins at `from_s`. Throws RecordingError. `speed`: recorded seconds a
    /// second.
    explicit RecordingPlayer(std::filesystem::path file, double speed = 1.0, double from_s = 0.0);

    /// Once a frame: goes on to where it should be by now. The first poll brings the bone as it first was.
    /// A frame that cannot be read ends the recording there, as LinkStatus::refused with the reason.
    LinkUpdate poll(Time now);
    /// Between polls: its time stands until the next, because a person could not see what happens.
    void wait() { last_poll_.reset(); }
    LinkUpdate poll() override { return poll(std::chrono::steady_clock::now()); }

    const Bone* bone() const override { return &playhead_->bone(); }
    const SessionInfo* session() const override { return &playhead_->session(); }
    RecordingPlayer* player() override { return this; }
    std::string finish() override { return error_; }

    bool is_playing() const { return is_playing_; }
    /// At the end, from the beginning.
    void play();
    void pause() { is_playing_ = false; }
    double speed() const { return speed_; }
    void set_speed(double speed);
    /// Anywhere from the first bone to duration_s(); a time beyond counts as the nearest end.
    void seek(double time_s);

    /// The time that it is at or, while it seeks, the time that it is going to.
    double time_s() const { return target_s_; }
    double duration_s() const { return outline_.duration_s; }
    /// Whether it states the viewpoint of the person who moved the tool.
    bool has_view() const { return outline_.has_view; }
    /// The moments worth seeing.
    const std::vector<RecordedMoment>& moments() const { return outline_.moments; }
    /// Whether it shows the state of time_s(), or the last that can be shown.
    bool has_arrived() const;
    /// Why it is not read further; empty while all is well.
    const std::string& error() const { return error_; }
    std::size_t key_frame_bytes() const { return keys_->memory_bytes(); }

  private:
    void open();
    void go_towards_target(LinkUpdate& update);
    void announce_bone(LinkUpdate& update);
    void wind_back();
    std::string status_line() const;

    const std::filesystem::path file_;
    double speed_;
    RecordingOutline outline_;
    double target_s_ = 0.0;
    bool is_playing_ = true;
    std::optional<Time> last_poll_;
    std::optional<Playhead> playhead_;
    std::optional<KeyFrames> keys_;
    double begins_s_ = 0.0;          // when the first bone begins
    double session_begins_s_ = 0.0;  // when this session's begins; winding back further needs the whole file
    bool is_fresh_ = true;           // the bone has not been shown yet
    std::size_t shown_structures_ = 0;  // how many of the playhead's
    bool is_at_end_ = false;
    bool tool_is_news_ = false;
    std::string error_;
    RateMeter frame_rate_;
    RateMeter byte_rate_;
};

}  // namespace osteomill
