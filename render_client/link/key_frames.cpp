#include "render_client/link/key_frames.h"

#include <zstd.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace osteomill {

namespace {

constexpr int compression_level = 1;

}  // namespace

KeyFrames::KeyFrames(Playhead::Mark start) : marks_{std::move(start)}, compressor_(compression_level) {}

void KeyFrames::before_step(const Playhead& playhead) {
    const StateArrived* next = playhead.next_state();
    if (next == nullptr) return;
    const bool is_news = *playhead.next_time_s() >= marks_.back().time_s;
    for (const ChangedBrick& changed : next->changes) {
        const BrickIndex brick = changed.change.brick;
        const std::int32_t slot = playhead.bone().slot(brick);
        if (slot == BoneContent::no_slot) continue;  // the playhead will refuse it
        if (is_news) changed_.insert(brick);
        // Until now it was as it first came.
        if (!versions_.contains(brick)) keep(brick, playhead.bone().fractions(slot), 0);
    }
}

void KeyFrames::after_step(const Playhead& playhead) {
    if (playhead.time_s() < marks_.back().time_s + interval_s) return;
    marks_.push_back(playhead.mark());
    for (const BrickIndex brick : changed_)
        keep(brick, playhead.bone().fractions(playhead.bone().slot(brick)), marks_.size() - 1);
    changed_.clear();
}

void KeyFrames::wind_back(Playhead& playhead, double time_s) const {
    const auto later = std::ranges::upper_bound(marks_, time_s, {}, &Playhead::Mark::time_s);
    const auto key = static_cast<std::size_t>(std::max<std::ptrdiff_t>(later - marks_.begin(), 1) - 1);
    ByteBrick fractions;
    for (const auto& [brick, versions] : versions_) {
        const auto newer = std::ranges::upper_bound(versions, key, {}, &Version::key);
        const std::vector<std::uint8_t>& compressed = std::prev(newer)->compressed;
        const std::size_t size =
            ZSTD_decompress(fractions.data(), fractions.size(), compressed.data(), compressed.size());
        if (size != fractions.size()) throw std::logic_error("a key frame cannot be unpacked");
        playhead.set_fractions(brick, fractions);
    }
    playhead.go_back_to(marks_[key]);
}

void KeyFrames::keep(BrickIndex brick, BrickFractions fractions, std::size_t key) {
    const auto compressed = compressor_.compress(fractions);
    memory_bytes_ += compressed.size() + sizeof(Version);
    versions_[brick].push_back({key, {compressed.begin(), compressed.end()}});
}

}  // namespace osteomill
