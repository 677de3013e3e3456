// Histogram of the values of a scan, and reasons against their being HU.
//
// The scale of CT numbers is fixed by air (-1000) and water (0), and every scan of a patient has some air. A
// file that was saved without its offset, a label map or an 8-bit picture becomes a bone as well as a CT
// does, but a wrong one.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace osteomill {

class HuHistogram {
  public:
    HuHistogram();

    /// Values beyond -4096 to 8191 count as these. Values that are not a number do not count.
    void add(std::span<const float> values);
    void add(std::span<const std::int16_t> values);

    /// The highest value so far, rounded; the lowest that counts if there is none.
    int highest_hu() const;

    /// The constant that a field of view was filled with around it: the lowest value, if it lies below all
    /// air and far below all other values.
    std::optional<float> fill_hu() const;

    /// One line for people on the scale that the values seem to have instead, and on the option that would
    /// make HU of them; empty if they may be HU, or all are the same.
    std::string doubt() const;

  private:
    /// The lowest HU above the lowest that counts; the latter if there is none.
    int second_lowest_hu() const;

    std::vector<std::uint64_t> count_of_hu_;
    std::uint64_t not_whole_ = 0;
    float lowest_ = std::numeric_limits<float>::max();
    std::uint64_t count_of_lowest_ = 0;
};

}  // namespace osteomill
