#include "analysis/report/session_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "analysis/report/bone_view.h"
#include "analysis/report/planned_region.h"
#include "analysis/report/png_uri.h"
#include "common/recording/playhead.h"

namespace osteomill {

namespace {

constexpr int picture_px = 300;
constexpr std::size_t most_marks = 24;
constexpr double least_half_width_mm = 4.0;

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    bool is_empty() const { return !(low.x <= high.x); }
    void hold(const glm::dvec3& place) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    glm::dvec3 centre() const { return 0.5 * (low + high); }
    double half_size() const { return 0.5 * glm::length(high - low); }
};

void hold_brick(Box& box, const Bone& bone, std::int32_t slot, auto&& is_wanted) {
    const BoneContent& content = bone.content();
    const glm::ivec3 first =
        brick_edge_voxels *
        brick_position(content.size_bricks, content.brick_of_slot[static_cast<std::size_t>(slot)]);
    for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
        if (is_wanted(offset)) box.hold(centre_of_voxel_mm(bone.grid(), first + voxel_in_brick(offset)));
}

/// What was planned and what was removed; all bricks of the bone where there is neither.
Box place_of_work(const SessionTrace& trace) {
    Box box;
    std::optional<PlannedRegion> region;
    if (trace.session.plan) region.emplace(trace.at_start, trace.session);
    const auto slots = static_cast<std::int32_t>(trace.at_start.stored_bricks());
    for (std::int32_t slot = 0; slot < slots; ++slot) {
        const BrickFractions before = trace.at_start.fractions(slot);
        const BrickFractions after = trace.at_end.fractions(slot);
        const bool has_changed = !std::ranges::equal(before, after);
        if (!has_changed && !region) continue;
        hold_brick(box, trace.at_start, slot, [&](std::size_t offset) {
            return before[offset] != after[offset] || (region && region->voxels().contains(slot, offset));
        });
    }
    if (!box.is_empty()) return box;
    for (std::int32_t slot = 0; slot < slots; ++slot)
        hold_brick(box, trace.at_start, slot,
                   [](std::size_t offset) { return offset == 0 || offset == brick_voxel_count - 1; });
    return box;
}

/// The spindle's direction when bone first went; else as the session began.
glm::dvec3 handpiece_axis(const SessionTrace& trace) {
    glm::dvec3 axis(0.0, 0.0, 1.0);
    const auto cutting = std::ranges::find_if(trace.samples, &TraceSample::cuts);
    if (cutting != trace.samples.end())
        axis = cutting->spindle_axis;
    else if (!trace.samples.empty())
        axis = trace.samples.front().spindle_axis;
    const double length = glm::length(axis);
    return length > 1e-6 ? axis / length : glm::dvec3(0.0, 0.0, 1.0);
}

glm::dvec3 square_to(const glm::dvec3& direction) {
    const glm::dvec3 wanted = std::abs(direction.z) > 0.7 ? glm::dvec3(0, -1.0, 0) : glm::dvec3(0, 0, 1.0);
    return glm::normalize(wanted - glm::dot(wanted, direction) * direction);
}

struct NamedView {
    std::string title;
    BoneView view;
};

std::vector<NamedView> views_of(const SessionTrace& trace) {
    const Box box = place_of_work(trace);
    if (box.is_empty()) return {};
    const glm::dvec3 centre = box.centre();
    const double half_width_mm = std::max(least_half_width_mm, 1.35 * box.half_size());
    const glm::dvec3 axis = handpiece_axis(trace);
    return {{"from the handpiece", {centre, -axis, square_to(-axis), half_width_mm, false}},
            {"section, from the front", {centre, {0, 1.0, 0}, {0, 0, 1.0}, half_width_mm, true}},
            {"section, from the left", {centre, {-1.0, 0, 0}, {0, 0, 1.0}, half_width_mm, true}}};
}

std::string picture(const Bone& bone, const SessionTrace& trace, const BoneView& view) {
    return png_data_uri(picture_of(bone, trace.session.tissues, view, picture_px));
}

/// As read_trace, the last session only.
void add_marks(const std::filesystem::path& file, const SessionTrace& trace, const BoneView& view,
               const std::function<void()>& on_frame, SessionPictures& pictures) {
    Playhead playhead(file);
    try {
        for (;;) {
            on_frame();
            const Playhead::Step step = playhead.step(std::numeric_limits<double>::infinity());
            if (step == Playhead::Step::end) return;
            if (step == Playhead::Step::new_bone) pictures.marks.clear(), pictures.marks_left_out = 0;
            if (step != Playhead::Step::state) continue;
            for (const ControlEvent& event : playhead.state().events) {
                if (event.action != SessionAction::mark || event.is_refused) continue;
                if (pictures.marks.size() < most_marks)
                    pictures.marks.push_back({fmt::format("{:.1f} s {}", event.time_s, event.text),
                                              picture(playhead.bone(), trace, view)});
                else
                    ++pictures.marks_left_out;
            }
        }
    } catch (const RecordingError&) {
        // The trace says it.
    }
}

}  // namespace

SessionPictures session_pictures(const std::filesystem::path& file, const SessionTrace& trace,
                                 const std::function<void()>& on_frame) {
    SessionPictures pictures;
    const std::vector<NamedView> views = views_of(trace);
    if (views.empty()) return pictures;
    on_frame();
    // At once: a session's end waits for them.
    const auto begin = [&trace](const Bone& bone, const NamedView& view) {
        return std::async(std::launch::async, [&] { return picture(bone, trace, view.view); });
    };
    std::vector<std::future<std::string>> before;
    std::vector<std::future<std::string>> after;
    for (const NamedView& view : views) {
        before.push_back(begin(trace.at_start, view));
        after.push_back(begin(trace.at_end, view));
    }
    for (std::size_t i = 0; i < views.size(); ++i) {
        pictures.before.push_back({views[i].title, before[i].get()});
        pictures.after.push_back({views[i].title, after[i].get()});
    }
    const bool has_marks = std::ranges::any_of(trace.events, [](const ControlEvent& event) {
        return event.action == SessionAction::mark && !event.is_refused;
    });
    if (has_marks) add_marks(file, trace, views.front().view, on_frame, pictures);
    return pictures;
}

}  // namespace osteomill
