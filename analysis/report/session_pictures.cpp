#include "analysis/report/session_pictures.h"

#include <fmt/format.h>
#include <openssl/evp.h>
#include <png.h>

#include <algorithm>
#include <cstring>
#include <future>
#include <glm/geometric.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "analysis/report/html_text.h"
#include "analysis/report/picture_overlay.h"
#include "analysis/report/picture_views.h"
#include "common/recording/playhead.h"
#include "common/words/decimal_sign.h"

namespace osteomill {

namespace {

constexpr int picture_px = 300;
constexpr int first_picture_px = 640;
constexpr std::size_t most_marks = 24;

/// A picture as a PNG within a page: data:image/png;base64,... Throws std::runtime_error if libpng fails.
std::string png_data_uri(const RgbPicture& picture) {
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.format = PNG_FORMAT_RGB;
    image.width = image.height = static_cast<png_uint_32>(picture.size_px);
    png_alloc_size_t bytes = 0;
    if (!png_image_write_to_memory(&image, nullptr, &bytes, 0, picture.rgb.data(), 0, nullptr))
        throw std::runtime_error(std::string("cannot make a PNG picture: ") + image.message);
    std::vector<unsigned char> png(bytes);
    if (!png_image_write_to_memory(&image, png.data(), &bytes, 0, picture.rgb.data(), 0, nullptr))
        throw std::runtime_error(std::string("cannot make a PNG picture: ") + image.message);
    std::vector<unsigned char> text(4 * ((bytes + 2) / 3) + 1);
    const int length = EVP_EncodeBlock(text.data(), png.data(), static_cast<int>(bytes));
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
            picture.title = fmt::format("{}: {} s {}", number,
                                        with_decimal_sign(fmt::format("{:.1f}", event.time_s)), event.text);
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
