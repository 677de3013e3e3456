#include "imaging/resampling/hu_histogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace osteomill {

namespace {

constexpr int lowest_bin_hu = -4096;
constexpr int highest_bin_hu = 8191;
constexpr int highest_of_a_byte = 255;
/// A segmentation of a head has a dozen labels; a scan has hundreds of values.
constexpr int most_labels = 32;
/// Air that is stored as 0 goes below 0 by noise, unless it is cut off: at -5 if the scanner cut it off at
/// -1024 and that is the offset, at -24 if the offset is 1000.
constexpr int lowest_of_stored_air = -100;
constexpr int lowest_of_air_cut_off = -5;
constexpr int highest_of_stored_air = 100;
/// Brain and muscle lie near 0, too: at 25 to 60 HU.
constexpr int most_of_median_of_air = 15;
/// The area outside a scanner's round field of view often has one value of its own, far below all others.
constexpr int least_gap_above_padding = 64;
/// Air has noise around -1000; tissue lies above this.
constexpr float lowest_air_hu = -1100.0F;
/// A constant near -1000 in more of a scan is its air, not the outside of a round field of view.
constexpr double most_padding_like_air = 0.25;
constexpr int highest_of_cut_off_air = 5;
constexpr double least_share_cut_off = 0.02;
constexpr double least_share_of_air = 0.05;
/// Metal does so in a few voxels.
constexpr double least_share_beyond_hu = 0.2;
/// Bone, on a scale that is off by as much as air is.
constexpr int highest_of_soft_tissue_with_offset = 1300;

}  // namespace

HuHistogram::HuHistogram() : count_of_hu_(highest_bin_hu - lowest_bin_hu + 1) {}

void HuHistogram::add(std::span<const float> values) {
    for (const float value : values) {
        if (std::isnan(value)) continue;
        if (value < lowest_) {
            lowest_ = value;
            count_of_lowest_ = 0;
        }
        count_of_lowest_ += value == lowest_ ? 1 : 0;
        const float whole = std::round(
            std::clamp(value, static_cast<float>(lowest_bin_hu), static_cast<float>(highest_bin_hu)));
        ++count_of_hu_[static_cast<std::size_t>(static_cast<int>(whole) - lowest_bin_hu)];
        if (whole != value) ++not_whole_;
    }
}

void HuHistogram::add(std::span<const std::int16_t> values) {
    for (const std::int16_t value : values)
        ++count_of_hu_[static_cast<std::size_t>(
            std::clamp(static_cast<int>(value), lowest_bin_hu, highest_bin_hu) - lowest_bin_hu)];
}

int HuHistogram::highest_hu() const {
    const auto last = std::find_if(count_of_hu_.rbegin(), count_of_hu_.rend(),
                                   [](std::uint64_t count) { return count > 0; });
    return last == count_of_hu_.rend() ? lowest_bin_hu
                                       : lowest_bin_hu + static_cast<int>(count_of_hu_.rend() - last) - 1;
}

int HuHistogram::second_lowest_hu() const {
    const auto is_met = [](std::uint64_t count) { return count > 0; };
    const auto lowest = std::find_if(count_of_hu_.begin(), count_of_hu_.end(), is_met);
    if (lowest == count_of_hu_.end()) return lowest_bin_hu;
    const auto second = std::find_if(lowest + 1, count_of_hu_.end(), is_met);
    return lowest_bin_hu +
           static_cast<int>((second == count_of_hu_.end() ? lowest : second) - count_of_hu_.begin());
}

std::optional<float> HuHistogram::fill_hu() const {
    if (!(lowest_ < lowest_air_hu)) return std::nullopt;
    const auto bin = static_cast<int>(std::round(std::max(lowest_, static_cast<float>(lowest_bin_hu))));
    const bool is_one_value = count_of_hu_[static_cast<std::size_t>(bin - lowest_bin_hu)] == count_of_lowest_;
    if (!is_one_value || second_lowest_hu() - bin < least_gap_above_padding) return std::nullopt;
    return lowest_;
}

std::string HuHistogram::doubt() const {
    const auto is_met = [](std::uint64_t count) { return count > 0; };
    const auto distinct = std::count_if(count_of_hu_.begin(), count_of_hu_.end(), is_met);
    const auto all = std::accumulate(count_of_hu_.begin(), count_of_hu_.end(), std::uint64_t{0});
    constexpr const char* no_hu =
        "its values {}, not HU; bone_import --intensity-window LOW,HIGH makes HU of them";
    if (static_cast<double>(count_of_hu_.back()) > least_share_beyond_hu * static_cast<double>(all))
        return fmt::format(no_hu, fmt::format("lie at {} and above", highest_bin_hu));
    if (distinct < 2)
        return not_whole_ == 0 ? ""
                               : fmt::format(no_hu, fmt::format("are fractions that all round to {}, as "
                                                                "attenuation is",
                                                                highest_hu()));
    const auto hu_of = [&](auto bin) { return static_cast<int>(bin) + lowest_bin_hu; };
    const auto first_met = [&](auto from) {
        return hu_of(std::find_if(from, count_of_hu_.end(), is_met) - count_of_hu_.begin());
    };
    const int lowest = first_met(count_of_hu_.begin());
    const int highest = highest_hu();
    if (lowest >= 0 && highest <= highest_of_a_byte) {
        if (distinct <= most_labels && not_whole_ == 0)
            return fmt::format("its values are {} whole numbers from {} to {}, as of a label map, not HU",
                               distinct, lowest, highest);
        return fmt::format(
            "its values run from {} to {}, as of a picture of 8 bits, not HU; bone_import --intensity-window "
            "LOW,HIGH "
            "makes HU of them",
            lowest, highest);
    }
    const double share_of_lowest =
        static_cast<double>(count_of_hu_[static_cast<std::size_t>(lowest - lowest_bin_hu)]) /
        static_cast<double>(all);
    const bool is_padded = second_lowest_hu() - lowest >= least_gap_above_padding;
    const bool is_air = lowest > static_cast<int>(lowest_air_hu) && share_of_lowest > most_padding_like_air;
    const int lowest_of_field = is_padded && !is_air ? second_lowest_hu() : lowest;
    if (lowest_of_field < lowest_of_stored_air || highest <= highest_of_soft_tissue_with_offset) return {};
    const auto begin = count_of_hu_.begin() + (lowest_of_stored_air - lowest_bin_hu);
    const auto end = begin + (highest_of_stored_air - lowest_of_stored_air);
    const auto near_zero = std::accumulate(begin, end, std::uint64_t{0});
    const double share = static_cast<double>(near_zero) / static_cast<double>(all);
    if (share < least_share_of_air) return {};
    std::uint64_t below = 0;
    const auto median = std::find_if(begin, end, [&](std::uint64_t count) {
        below += count;
        return 2 * below >= near_zero;
    });
    // If air was not cut off, its middle is 0; if it was, much of it is at the lowest value.
    const auto cut_off =
        std::accumulate(begin, begin + (highest_of_cut_off_air + 1 - lowest_of_stored_air), std::uint64_t{0});
    const bool is_cut_off =
        lowest_of_field >= lowest_of_air_cut_off &&
        static_cast<double>(cut_off) > least_share_cut_off * static_cast<double>(near_zero);
    if (!is_cut_off && hu_of(median - count_of_hu_.begin()) > most_of_median_of_air) return {};
    return fmt::format(
        "nothing is below {}{} and {:.0f} % are near 0, as where air is stored as 0; in HU air is -1000: "
        "bone_import --rescale 1,-1024 (or 1,-1000) makes HU of them",
        lowest_of_field,
        lowest_of_field == lowest
            ? ""
            : fmt::format(" but the constant {} of {:.0f} %", lowest, 100.0 * share_of_lowest),
        100.0 * share);
}

}  // namespace osteomill
