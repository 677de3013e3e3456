#include "slicer/image_schedule.h"

namespace osteomill {

void ImageSchedule::restart(const ReducedBox& whole) {
    *this = {};
    whole_ = whole;
}

void ImageSchedule::changed(const ReducedBox& box, double now_s) {
    last_change_s_ = now_s;
    has_changed_since_whole_ = true;
    // Changes that were not sent yet become one part.
    if (!changes_.empty() && !changes_.back().first_sent_s)
        changes_.back().box = around(changes_.back().box, box);
    else
        changes_.push_back({box});
}

ReducedBox ImageSchedule::send_whole(double now_s) {
    whole_sent_s_ = last_sent_s_ = now_s;
    has_changed_since_whole_ = false;
    // A part that follows may replace the whole before the whole is imported.
    for (Change& change : changes_)
        if (!change.first_sent_s) change.first_sent_s = now_s;
    return *whole_;
}

std::optional<ReducedBox> ImageSchedule::next(double now_s) {
    if (!whole_) return std::nullopt;
    if (!whole_sent_s_) {
        begun_s_ = now_s;
        return send_whole(now_s);
    }
    if (has_changed_since_whole_ &&
        (now_s - last_change_s_ >= rests_after_s || now_s - *whole_sent_s_ >= between_wholes_s))
        return send_whole(now_s);
    while (!changes_.empty() && changes_.front().first_sent_s &&
           now_s - *changes_.front().first_sent_s > covered_s)
        changes_.pop_front();
    const bool has_news = !changes_.empty() && !changes_.back().first_sent_s;
    if (!has_news || now_s - last_sent_s_ < between_parts_s) return std::nullopt;
    // A part that replaced the first whole would leave the receiver's image incomplete.
    if (now_s - begun_s_ < covered_s) return send_whole(now_s);
    last_sent_s_ = now_s;
    ReducedBox box = changes_.front().box;
    for (Change& change : changes_) {
        box = around(box, change.box);
        if (!change.first_sent_s) change.first_sent_s = now_s;
    }
    return box;
}

}  // namespace osteomill
