// Key frames of a bone that is being milled, so that a recording can be wound back without reading it from
// its beginning.
//
// A key frame holds only the bricks that changed since the one before, compressed; a brick that nothing has
// changed yet is held nowhere. The memory is that of the bone that was milled, not of the bone.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "common/bone/bone.h"
#include "common/recording/playhead.h"
#include "common/wire/zstd_compressor.h"

namespace osteomill {

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

}  // namespace osteomill
