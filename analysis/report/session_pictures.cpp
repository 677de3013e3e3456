#include "analysis/report/session_pictures.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "analysis/report/page_style.h"
#include "analysis/report/picture_overlay.h"
#include "common/recording/playhead.h"
#include "common/words/translation.h"

namespace osteomill {

namespace {

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
    double half_width_mm() const {
        return std::max(least_half_width_mm, 1.35 * 0.5 * glm::length(high - low));
    }
};

/// Box of the voxels of stored bricks that `is_wanted(slot, offset)`.
Box box_of(const Bone& bone, auto&& is_wanted) {
    Box box;
    const BoneContent& content = bone.content();
    for (std::int32_t slot = 0; slot < static_cast<std::int32_t>(bone.stored_bricks()); ++slot) {
        const glm::ivec3 first =
            brick_edge_voxels *
            brick_position(content.size_bricks, content.brick_of_slot[static_cast<std::size_t>(slot)]);
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
            if (is_wanted(slot, offset))
                box.hold(centre_of_voxel_mm(bone.grid(), first + voxel_in_brick(offset)));
    }
    return box;
}

Box box_of_plan(const SessionTrace& trace, const PlannedRegion* region) {
    if (region == nullptr) return {};
    return box_of(trace.at_start,
                  [&](auto slot, auto offset) { return region->voxels().contains(slot, offset); });
}

Box box_of_work(const SessionTrace& trace, const PlannedRegion* region) {
    Box box = box_of_plan(trace, region);
    const Box removed = box_of(trace.at_start, [&](auto slot, auto offset) {
        return trace.at_start.fractions(slot)[offset] != trace.at_end.fractions(slot)[offset];
    });
    for (const Box& part : {box, removed})
        if (!part.is_empty()) box.hold(part.low), box.hold(part.high);
    if (!box.is_empty()) return box;
    return box_of(trace.at_start,
                  [](auto, std::size_t offset) { return offset == 0 || offset == brick_voxel_count - 1; });
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

/// As radiologists see them: the patient's right at the picture's left.
NamedView section_from_front(const glm::dvec3& centre_mm, double half_width_mm) {
    return {tr("section, from the front"), {centre_mm, {0, 1.0, 0}, {0, 0, 1.0}, half_width_mm, true}};
}

NamedView section_from_left(const glm::dvec3& centre_mm, double half_width_mm) {
    return {tr("section, from the left"), {centre_mm, {-1.0, 0, 0}, {0, 0, 1.0}, half_width_mm, true}};
}

NamedView section_from_below(const glm::dvec3& centre_mm, double half_width_mm) {
    return {tr("section, from below"), {centre_mm, {0, 0, 1.0}, {0, -1.0, 0}, half_width_mm, true}};
}

/// The anatomical section whose plane is closest to the direction.
NamedView section_along(const glm::dvec3& direction, const glm::dvec3& centre_mm, double half_width_mm) {
    const glm::dvec3 size = glm::abs(direction);
    if (size.y <= size.x && size.y <= size.z) return section_from_front(centre_mm, half_width_mm);
    if (size.x <= size.z) return section_from_left(centre_mm, half_width_mm);
    return section_from_below(centre_mm, half_width_mm);
}

glm::dvec3 nearest_voxel_mm(const StructureMask& mask, const glm::dvec3& from_mm) {
    glm::dvec3 nearest = from_mm;
    double least_mm = std::numeric_limits<double>::infinity();
    const glm::ivec3 size_bricks = size_in_bricks(mask.grid());
    for (const StructureBrick& brick : mask.bricks()) {
        const glm::ivec3 first = brick_edge_voxels * brick_position(size_bricks, brick.brick);
        brick.voxels.for_each([&](std::size_t offset) {
            const glm::dvec3 place = centre_of_voxel_mm(mask.grid(), first + voxel_in_brick(offset));
            if (const double mm = glm::length(place - from_mm); mm < least_mm) least_mm = mm, nearest = place;
        });
    }
    return nearest;
}

}  // namespace

std::vector<NamedView> views_of_work(const SessionTrace& trace, const PlannedRegion* region) {
    const Box box = box_of_work(trace, region);
    if (box.is_empty()) return {};
    const glm::dvec3 centre = box.centre();
    const glm::dvec3 axis = handpiece_axis(trace);
    return {{tr("from the handpiece"), {centre, -axis, square_to(-axis), box.half_width_mm(), false}},
            section_from_front(centre, box.half_width_mm()),
            section_from_left(centre, box.half_width_mm())};
}

std::optional<NearestApproach> nearest_approach(const SessionTrace& trace) {
    NearestApproach nearest;
    std::size_t tissue = 0;
    for (const TraceSample& sample : trace.samples)
        for (const StructureDistance& one : sample.distances)
            if (one.distance_mm && (nearest.sample == nullptr || *one.distance_mm < nearest.distance_mm)) {
                nearest.sample = &sample;
                nearest.distance_mm = *one.distance_mm;
                tissue = one.tissue;
            }
    const auto structure = std::ranges::find(trace.structure_places, tissue, &Structure::tissue);
    if (nearest.sample == nullptr || structure == trace.structure_places.end()) return std::nullopt;
    nearest.structure = trace.session.tissues[tissue].name;
    nearest.structure_mm = nearest_voxel_mm(structure->mask, nearest.sample->burr_mm);
    nearest.distance_mm = std::max(0.0, nearest.distance_mm);
    return nearest;
}

std::optional<NamedView> view_of_target(const SessionTrace& trace, const PlannedRegion* region) {
    Box box = box_of_plan(trace, region);
    if (box.is_empty()) box = box_of_work(trace, region);
    if (box.is_empty()) return std::nullopt;
    NamedView target = section_along(handpiece_axis(trace), box.centre(), box.half_width_mm());
    target.title = region != nullptr ? trf("Through the target, {}", target.title)
                                     : trf("Through the work, {}", target.title);
    return target;
}

NamedView view_of(const NearestApproach& approach, double burr_diameter_mm) {
    const glm::dvec3 apart = approach.structure_mm - approach.sample->burr_mm;
    const double half_width_mm =
        std::max(least_half_width_mm, 1.5 * (glm::length(apart) + 0.5 * burr_diameter_mm));
    NamedView view = section_along(apart, approach.sample->burr_mm, half_width_mm);
    const std::string structure = tissue_words(approach.structure);
    const std::string time_s = spoken_number("{:.1f}", approach.sample->time_s);
    view.title = approach.distance_mm > 0.0
                     ? trf("{} mm from the {}, at {} s, {}", spoken_number("{:.2f}", approach.distance_mm),
                           structure, time_s, view.title)
                     : trf("Touch of the {}, at {} s, {}", structure, time_s, view.title);
    return view;
}

namespace {

constexpr int picture_px = 300;
constexpr int first_picture_px = 640;
constexpr std::size_t most_marks = 24;

/// A picture as a PNG within a page: data:image/png;base64,... Throws std::runtime_error.
std::string png_data_uri(const RgbPicture& picture) {
    const std::string png = lasting_png(picture.rgb, glm::ivec2(picture.size_px));
    std::vector<unsigned char> text(4 * ((png.size() + 2) / 3) + 1);
    const int length = EVP_EncodeBlock(text.data(), reinterpret_cast<const unsigned char*>(png.data()),
                                       static_cast<int>(png.size()));
    return "data:image/png;base64," + std::string(text.begin(), text.begin() + length);
}

class Pictures {
  public:
    Pictures(const SessionTrace& trace, const PlannedRegion* region) : trace_(trace), region_(region) {}

    ReportPicture of(const Bone& bone, const NamedView& view, int size_px,
                     const std::optional<SeenBurr>& burr = {}) const {
        SectionMarks marks{.structures = trace_.structure_places};
        if (region_ != nullptr && region_->is_tissue())
            marks.is_outlined_voxel = [&](const glm::ivec3& voxel) { return region_->has_tissue(voxel); };
        else if (region_ != nullptr)
            marks.is_outlined = [&](const glm::dvec3& at) { return region_->holds(at); };
        return {view.title, png_data_uri(picture_of(bone, trace_.session.tissues, view.view, size_px, marks)),
                picture_overlay(view.view, burr)};
    }
    /// All at the same time: a session's end waits for them. The bone outlives it.
    std::future<ReportPicture> begin(const Bone& bone, const NamedView& view, int size_px,
                                     const std::optional<SeenBurr>& burr = {}) const {
        return std::async(std::launch::async, [=, this, &bone] { return of(bone, view, size_px, burr); });
    }

  private:
    const SessionTrace& trace_;
    const PlannedRegion* region_;
};

/// Only the last session, as in read_trace.
void add_marks(const std::filesystem::path& file, const Pictures& make, const NamedView& view,
               const ReportProgress& on_frame, SessionPictures& pictures) {
    Playhead playhead(file);
    std::size_t number = 0;
    // The trace says why a torn recording ends there.
    (void)play_to_end(playhead, on_frame, [&](Playhead::Step step) {
        if (step == Playhead::Step::new_bone) pictures.marks.clear(), pictures.marks_left_out = 0, number = 0;
        if (step != Playhead::Step::state) return;
        for (const ControlEvent& event : playhead.state().events) {
            ++number;
            if (event.action != SessionAction::mark || event.is_refused) continue;
            if (pictures.marks.size() == most_marks) {
                ++pictures.marks_left_out;
                continue;
            }
            ReportPicture picture = make.of(playhead.bone(), view, picture_px);
            picture.title =
                fmt::format("{}: {} s {}", number, spoken_number("{:.1f}", event.time_s), event.text);
            pictures.marks.push_back(std::move(picture));
        }
    });
}

/// Through the target and the nearest approach; if the burr came near nothing, through the work from two
/// sides.
std::vector<std::future<ReportPicture>> begin_first(const SessionTrace& trace, const Pictures& make,
                                                    const PlannedRegion* region, const NamedView& otherwise) {
    std::vector<std::future<ReportPicture>> pictures;
    if (const auto target = view_of_target(trace, region))
        pictures.push_back(make.begin(trace.at_end, *target, first_picture_px));
    if (const auto approach = nearest_approach(trace)) {
        const TraceSample& there = *approach->sample;
        const double diameter_mm = trace.session.burrs[there.burr].diameter_mm;
        pictures.push_back(
            make.begin(trace.at_end, view_of(*approach, diameter_mm), first_picture_px,
                       SeenBurr{there.burr_mm, glm::normalize(there.spindle_axis), diameter_mm}));
    } else {
        pictures.push_back(make.begin(trace.at_end, otherwise, first_picture_px));
    }
    return pictures;
}

}  // namespace

SessionPictures session_pictures(const std::filesystem::path& file, const SessionTrace& trace,
                                 const ReportProgress& on_frame) {
    SessionPictures pictures;
    std::optional<PlannedRegion> plan;
    if (trace.session.plan) plan.emplace(trace.at_start, trace.session);
    const PlannedRegion* const region = plan ? &*plan : nullptr;
    const std::vector<NamedView> views = views_of_work(trace, region);
    if (views.empty()) return pictures;
    on_frame(0.0);
    const Pictures make(trace, region);
    auto first = begin_first(trace, make, region, views.back());
    std::vector<std::future<ReportPicture>> before;
    std::vector<std::future<ReportPicture>> after;
    for (const NamedView& view : views) {
        before.push_back(make.begin(trace.at_start, view, picture_px));
        after.push_back(make.begin(trace.at_end, view, picture_px));
    }
    for (auto& picture : first) pictures.first.push_back(picture.get());
    for (auto& picture : before) pictures.before.push_back(picture.get());
    for (auto& picture : after) pictures.after.push_back(picture.get());
    const bool has_marks = std::ranges::any_of(trace.events, [](const ControlEvent& event) {
        return event.action == SessionAction::mark && !event.is_refused;
    });
    if (has_marks) add_marks(file, make, views.front(), on_frame, pictures);
    return pictures;
}

std::string figures(const std::vector<ReportPicture>& pictures, const char* kind) {
    std::string html = fmt::format("<div class='pictures {}'>", kind);
    for (const ReportPicture& picture : pictures)
        html += fmt::format(
            "<figure><div class='seen'><img alt='{0}' "
            "src='{1}'>{2}</div><figcaption>{0}</figcaption></figure>",
            html_text(picture.title), picture.png_uri, picture.overlay);
    return html + "</div>";
}

}  // namespace osteomill
