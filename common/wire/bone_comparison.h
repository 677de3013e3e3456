// Search for the bricks in which two copies of a bone differ, without sending either.
//
// Checksums of bricks add up, so a range of bricks has one, too. The side in doubt sends the checksums of a
// hundred parts of its copy; the other side names the differing parts; these are cut into smaller parts, and
// so on down to single bricks. One differing brick is found in a bone of 8192 bricks with two requests of a
// kilobyte; in a bone of two million with three.
//
// If the other side changes meanwhile, a brick that only lags behind may be reported as different, which does
// no harm. A brick reported as equal is equal, except with probability 2^-64.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <variant>
#include <vector>

#include "common/bone/bone.h"
#include "common/wire/bone_replica.h"
#include "common/wire/frame.h"
#include "osteomill/v2/bone.pb.h"

namespace osteomill {

/// Keeps a request within 3 KiB, and the other side's work within one pass over its checksums.
inline constexpr std::size_t most_parts_of_a_comparison = 128;

/// A copy that needs more requests than this differs so widely that a fresh snapshot costs less.
inline constexpr int most_requests_of_a_search = 64;

/// The side of the copy that is in doubt.
class DifferenceSearch {
  public:
    /// `bone` is the copy; the same one is to be passed to next().
    explicit DifferenceSearch(const Bone& bone);

    /// The next question about the copy as it now is; nothing once all differences have been found. To be
    /// called when the request before has been answered.
    std::optional<v2::CompareBone> next(const Bone& bone, const RunningChecksum& checksum);

    /// The answer. Refuses an unexpected one, and parts that were not in the request.
    std::optional<WireError> take(const v2::Comparison& answer);

    bool awaits_answer() const { return !requested_.empty(); }
    int requests() const { return requests_; }
    /// Bricks that differ, so far.
    std::size_t bricks_found() const { return bricks_found_; }

  private:
    struct Range {
        BrickIndex first = 0;
        std::uint64_t count = 0;
    };
    std::map<BrickIndex, std::uint64_t> suspects_;  // ranges that differ: count by first brick
    std::vector<Range> requested_;                  // the parts of the request under way
    int requests_ = 0;
    std::size_t bricks_found_ = 0;
};

struct ComparedBone {
    v2::Comparison answer;
    std::vector<BrickIndex> differing_bricks;  ///< stored here: those to be sent whole
};

/// The side of the bone that counts. Refuses ranges that overlap or reach past the grid, parts that do not
/// make up their range, and more of them than most_parts_of_a_comparison.
std::variant<ComparedBone, WireError> compare_bone(const v2::CompareBone& request, const Bone& bone,
                                                   const RunningChecksum& checksum);

}  // namespace osteomill
