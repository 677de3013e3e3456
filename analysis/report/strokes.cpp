#include "analysis/report/strokes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "analysis/report/motion_metrics.h"
#include "common/session/stroke_span.h"
#include "common/statistics/percentile.h"

namespace osteomill {

namespace {

constexpr double shortest_smooth_s = 0.5;

/// Undone slices, as the server's journal keeps them.
class UndoneSlices {
  public:
    explicit UndoneSlices(std::vector<Stroke>& strokes) : strokes_(strokes) {}

    void take(std::size_t stroke, std::size_t slice) {
        done_.push_back({stroke, slice});
        undone_.clear();
    }
    void act(SessionAction action) {
        if (action == SessionAction::undo) move(done_, undone_, undos_++);
        if (action == SessionAction::redo) move(undone_, done_, std::nullopt);
        if (action == SessionAction::reset) {
            while (!done_.empty()) move(done_, undone_, undos_);
            ++undos_;
        }
    }

  private:
    struct Place {
        std::size_t stroke, slice;
    };
    void move(std::vector<Place>& from, std::vector<Place>& to, std::optional<std::size_t> undone_by) {
        if (from.empty()) return;  // of a stroke before the recording began
        to.push_back(from.back());
        from.pop_back();
        strokes_[to.back().stroke].slices[to.back().slice].undone_by = undone_by;
    }

    std::vector<Stroke>& strokes_;
    std::vector<Place> done_;
    std::vector<Place> undone_;
    std::size_t undos_ = 0;
};

std::optional<double> variation(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    if (values.size() < 3 || !(mean > 0.0)) return std::nullopt;
    const double squares =
        std::accumulate(values.begin(), values.end(), 0.0,
                        [mean](double sum, double value) { return sum + (value - mean) * (value - mean); });
    return std::sqrt(squares / (n - 1.0)) / mean;
}

}  // namespace

std::vector<Stroke> strokes_of(const SessionTrace& trace) {
    std::vector<Stroke> strokes;
    UndoneSlices undone(strokes);
    StrokeSpan span;
    UndoSlice slice;
    bool is_slice_open = false;
    Stroke so_far;  // with time that may turn out to be air after the last touch
    std::vector<TimedPosition> hand;
    std::size_t touched_hand = 0;  // so many of these are the stroke's
    bool is_open = false;
    auto event = trace.events.begin();
    const auto end_slice = [&] {
        if (std::exchange(is_slice_open, false))
            undone.take(strokes.size() - 1, strokes.back().slices.size() - 1);
    };
    const auto close = [&] {
        end_slice();
        if (!std::exchange(is_open, false)) return;
        Stroke& stroke = strokes.back();
        hand.resize(touched_hand);
        if (stroke.duration_s >= shortest_smooth_s) stroke.smoothness = log_dimensionless_jerk(hand);
    };
    const auto& samples = trace.samples;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const TraceSample& now = samples[i];
        const bool cuts = now.cuts();
        const bool goes_on = span.goes_on(now.time_s, now.spindle_on, cuts, now.force_n > 0.0);
        if (!goes_on) close();
        if (goes_on && !is_open) {
            is_open = true;
            const std::size_t before = i > 0 ? i - 1 : i;
            so_far = {.begins_s = samples[before].time_s};
            strokes.push_back(so_far);
            hand = {{samples[before].time_s, samples[before].hand_mm}};
        }
        if (goes_on && now.spindle_on && i > 0) {
            so_far.duration_s += trace.dt_s(i);
            so_far.length_mm += glm::length(now.burr_mm - samples[i - 1].burr_mm);
            so_far.force_n_s += now.force_n * trace.dt_s(i);
            hand.push_back({now.time_s, now.hand_mm});
        }
        if (cuts) {
            if (!std::exchange(is_slice_open, true)) so_far.slices.emplace_back();
            so_far.slices.back().levels_by_burr[now.burr] += now.milled();
        }
        if (span.touches()) {
            strokes.back() = so_far;
            touched_hand = hand.size();
        }
        if (slice.ends(now.time_s, goes_on, cuts)) end_slice();
        for (; event != trace.events.end() && event->time_s <= now.time_s; ++event)
            if (!event->is_refused) {
                if (event->action == SessionAction::undo || event->action == SessionAction::reset) close();
                undone.act(event->action);
            }
    }
    close();
    return strokes;
}

StrokeMetrics stroke_metrics(const std::vector<Stroke>& strokes) {
    StrokeMetrics metrics{.strokes = strokes.size()};
    if (strokes.empty()) return metrics;
    std::vector<double> smoothness;
    std::vector<double> reaches_per_s;
    std::vector<double> lengths_mm;
    std::vector<double> forces_n;
    for (const Stroke& stroke : strokes) {
        metrics.undone += stroke.is_undone() ? 1 : 0;
        metrics.mean_duration_s += stroke.duration_s;
        metrics.mean_length_mm += stroke.length_mm;
        metrics.longest_s = std::max(metrics.longest_s, stroke.duration_s);
        if (stroke.smoothness) {
            smoothness.push_back(*stroke.smoothness);
            reaches_per_s.push_back(reaches_in_a_row(*stroke.smoothness) / stroke.duration_s);
        }
        if (!(stroke.duration_s > 0.0)) continue;
        lengths_mm.push_back(stroke.length_mm);
        forces_n.push_back(stroke.force_n_s / stroke.duration_s);
    }
    metrics.mean_duration_s /= static_cast<double>(strokes.size());
    metrics.mean_length_mm /= static_cast<double>(strokes.size());
    metrics.length_variation = variation(lengths_mm);
    metrics.force_variation = variation(forces_n);
    if (!smoothness.empty()) {
        metrics.median_smoothness = percentile(smoothness, 0.5);
        metrics.median_reaches_per_s = percentile(reaches_per_s, 0.5);
    }
    return metrics;
}

}  // namespace osteomill
