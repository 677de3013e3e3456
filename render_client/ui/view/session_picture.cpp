#include "render_client/ui/view/session_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "common/log/log.h"
#include "common/session/tool_state.h"
#include "render_client/dataset/first_view.h"
#include "render_client/ui/panels/inset_panel.h"
#include "render_client/ui/panels/layout.h"
#include "render_client/ui/panels/start_panel.h"
#include "render_client/volume/camera.h"

namespace osteomill {

namespace {

bool is_as_drawn(const std::optional<OperatorCommand>& drawn, const std::optional<OperatorCommand>& now) {
    if (drawn.has_value() != now.has_value()) return false;
    return !now || (drawn->pedal == now->pedal &&
                    glm::distance(drawn->hand_target_mm, now->hand_target_mm) <= quiet_motion_mm);
}

}  // namespace

SessionNews news_since(const DrawnSession& drawn, const LinkUpdate& link,
                       const std::optional<ToolState>& tool,
                       const std::optional<OperatorCommand>& operator_command,
                       const std::optional<int>& preparation_percent) {
    const LinkUpdate& was = drawn.link;
    const bool has_moved = tool && !(drawn.tool && looks_the_same(*drawn.tool, *tool));
    if (has_moved || link.ct || !is_as_drawn(drawn.operator_command, operator_command) ||
        link.status != was.status || link.status_line != was.status_line ||
        link.recording_error != was.recording_error || link.controls != was.controls ||
        link.distances != was.distances || link.checksum_mismatches != was.checksum_mismatches ||
        link.rejected_frames != was.rejected_frames || link.bricks_repaired != was.bricks_repaired)
        return SessionNews::change;
    const bool time_goes_on = tool && tool->time_s != drawn.tool->time_s;
    const bool is_figure_new = time_goes_on || link.snapshot_bricks != was.snapshot_bricks ||
                               preparation_percent != drawn.preparation_percent ||
                               link.frames_per_s != was.frames_per_s || link.bytes_per_s != was.bytes_per_s;
    return is_figure_new ? SessionNews::figures : SessionNews::none;
}

namespace {

std::vector<TissueColour> colours_of(const SessionInfo* session) {
    return session ? tissue_colours(session->tissues) : std::vector<TissueColour>{};
}

}  // namespace

SessionPicture::SessionPicture(SessionSource& source, ImguiContext& panels, const glm::ivec2& size_px,
                               FrameQuality quality, RendererChoice renderer, const ShadingSettings& look,
                               const StereoSettings& stereo)
    : source_(source),
      panels_(panels),
      renderer_(make_renderer(renderer)),
      bone_(look),
      frame_quality_(quality),
      picture_(*renderer_, size_px, quality == FrameQuality::on_demand, stereo),
      renderer_choice_(renderer),
      size_px_(picture_.size_px()) {
    view_.transfer = TransferEditor(look.transfer);
}

SessionNews SessionPicture::take_in() {
    if (RecordingPlayer* player = source_.player(); player != nullptr && bone_.preparation()) player->wait();
    link_ = source_.poll();
    if (is_of_another_session()) {
        if (link_.bone_replaced || link_.status == LinkStatus::receiving_snapshot) {
            bone_.expect_another();
            forget_structures();
        }
        forget_session();
    }
    const bool first_of_tool = link_.tool && !tool_.state();
    if (link_.tool) {
        tool_.take(*link_.tool);
        history_.add(*link_.tool);
    }
    if (source_.bone()) take_in_bone(first_of_tool);
    if (link_.bone_replaced || !link_.changes.empty()) ++bone_version_;
    if (link_.ct) slices_.set_ct(link_.ct);
    ask_for_ct();
    return news();
}

/// Another scene, or the same begun anew; a recording's time runs back by itself.
bool SessionPicture::is_of_another_session() const {
    if (source_.player() == nullptr && link_.tool && tool_.state() &&
        link_.tool->time_s < tool_.state()->time_s)
        return true;
    const SessionInfo* session = source_.session();
    const bool announces_another = link_.status == LinkStatus::receiving_snapshot && has_bone() &&
                                   session != nullptr && session->scene_name != scene_name_;
    if (announces_another) return true;
    return has_taken_bone_ && link_.bone_replaced && session != nullptr && source_.bone() &&
           (session->scene_name != scene_name_ || source_.bone()->grid() != grid_);
}

/// A person's view of it tells nothing about the next, and nothing of it is drawn in the next.
void SessionPicture::forget_session() {
    tool_ = {};
    if (bone_.drop_former_bone().is_news()) {
        show_other_textures(DrawingCost::unknown);
        has_undrawn_bone_ = true;
    }
    for (std::size_t cut = 0; cut < CutSettings::count; ++cut) view_.cuts.switch_off(cut);
    has_first_view_ = false;
    camera_ = first_view_;
}

SessionSight SessionPicture::sight() const {
    const bool shows_its_bone = (has_bone() && !bone_.shows_former_bone()) || !bone_.problem().empty();
    return sight_of(link_, shows_its_bone, source_.player() != nullptr);
}

void SessionPicture::ask_for_ct() {
    if (!view_.slices_shown || link_.status != LinkStatus::live || ct_requested_in_ == link_.connections)
        return;
    ct_requested_in_ = link_.connections;
    slices_.set_ct(nullptr);
    if (tool_.state() && !slices_.cross_mm()) slices_.cross_at(tool_.state()->burr_position_mm);
    source_.ask_for_ct();
}

void SessionPicture::take_in_bone(bool first_of_tool) {
    const bool is_first = !std::exchange(has_taken_bone_, true);
    if (link_.bone_replaced || is_first) {
        bone_.replace(*source_.bone(), colours_of(source_.session()));
        grid_ = source_.bone()->grid();
        scene_name_ = source_.session() ? source_.session()->scene_name : "";
        has_undrawn_bone_ = true;
    } else {
        bone_.note(link_.changes);
        if (has_bone()) dirty_bricks_uploaded_ += link_.changes.size();
    }
    work_on_bone();
    if (link_.bone_replaced) {
        forget_structures();
        if (const SessionInfo* session = source_.session()) slices_.set_tissues(session->tissues);
    }
    for (const Structure& structure : link_.structures) take_in_structure(structure);
    take_in_fixtures();
    if (first_of_tool && has_bone()) find_first_view();
}

void SessionPicture::take_in_structure(const Structure& structure) {
    const SessionInfo* session = source_.session();
    if (!session || structure.tissue >= session->tissues.size()) return;
    const Tissue& tissue = session->tissues[structure.tissue];
    slices_.set_mask(structure.tissue, structure.mask);
    const StructureMask soft = soft_part(structure.mask, *source_.bone());
    bone_.add_structure(tissue.label, soft);
    picture_.add_structure(surface_of(soft, linear_from_srgb(tissue.colour_rgb)), tissue.opacity);
    fixture_borders_.take_in(*session, structure);
    has_undrawn_bone_ = true;
}

void SessionPicture::take_in_fixtures() {
    const SessionInfo* session = source_.session();
    if (session == nullptr || session->fixtures.empty() || !tool_.state()) return;
    // All structures have come before the first state.
    fixture_borders_.take_in_labels(*session, *source_.bone());
    const bool waits = frame_quality_ == FrameQuality::full;
    if (fixture_borders_.show(picture_, tool_.state()->fixtures_on, waits)) has_undrawn_bone_ = true;
}

void SessionPicture::forget_structures() {
    picture_.forget_structures();
    fixture_borders_.forget();
}

SessionNews SessionPicture::news() const {
    if (has_undrawn_bone_ || has_turning_burr() || !quality().refined || sight() != drawn_sight_)
        return SessionNews::change;
    return news_since(drawn_, link_, tool_.state(), operator_command_, preparation_percent());
}

void SessionPicture::work_on_bone() {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + preparing_slice_;
    const auto has_time = [&] { return frame_quality_ == FrameQuality::full || Clock::now() < end; };
    const BoneOnScreen::Outcome outcome = bone_.work(*source_.bone(), has_time);
    if (outcome.is_news()) has_undrawn_bone_ = true;
    if (outcome.other_textures) {
        show_other_textures(outcome.cost);
    } else if (!outcome.changed.empty()) {
        picture_.mark_dirty(*bone_.textures(), outcome.changed);
        if (inset_) inset_->mark_dirty(*bone_.textures(), outcome.changed);
    }
}

void SessionPicture::show_other_textures(DrawingCost cost) {
    picture_.forget_bone(cost);
    if (inset_) inset_->forget_bone(cost);
    const BoneTextures* textures = bone_.textures();
    if (textures == nullptr) return;
    if (textures->plan().layout != BoneLayout::dense || textures->plan().coarsening > 1)
        log_info("the bone is drawn from {}", description(textures->plan()));
    const glm::dvec3 half_mm = 0.5 * textures->grid().spacing_mm * glm::dvec3(textures->box().size);
    const glm::dvec3 middle_mm = ball_round(*textures).centre_mm;
    view_.cuts.set_bounds(middle_mm - half_mm, middle_mm + half_mm);
    // After a reconnection the view stays where the user left it.
    if (!std::exchange(has_first_view_, true)) find_first_view();
}

std::optional<int> SessionPicture::preparation_percent() const {
    const std::optional<double> done = bone_.preparation();
    if (!done) return std::nullopt;
    return static_cast<int>(100.0 * *done);
}

void SessionPicture::set_shading(const ShadingSettings& look) {
    if (look == bone_.look()) return;
    if (look.transfer) require_valid(*look.transfer);
    bone_.set_appearance(look);
    if (source_.bone() && has_taken_bone_) work_on_bone();
}

void SessionPicture::find_first_view() {
    const bool is_untouched = camera_ == first_view_;
    first_view_ = first_view(*source_.bone(), *bone_.textures(), source_.session(),
                             tool_.state() ? &*tool_.state() : nullptr);
    set_magnification(first_view_, first_magnification_);
    if (is_untouched) camera_ = first_view_;
}

const gl::Framebuffer& SessionPicture::draw(double elapsed_s) {
    tool_.turn(elapsed_s, session());
    // The mean of times, not of rates: a few frames that come at once would count for hundreds a second.
    frame_s_ = frame_s_ > 0.0 ? 0.9 * frame_s_ + 0.1 * elapsed_s : elapsed_s;
    if (view_.transfer.take_change())
        set_shading({.shading = bone_.look().shading, .transfer = view_.transfer.function()});
    const Theme& theme = theme_of(view_.theme);
    const SceneAppearance look{.cuts = view_.cuts.planes(),
                               .ct = view_.slices_shown ? slices_.ct() : nullptr,
                               .ct_window = slices_.window(),
                               .background_low = theme.background_low,
                               .background_high = theme.background_high,
                               .ambient_occlusion = view_.ambient_occlusion,
                               .thin_bone = view_.thin_bone,
                               .smooth_silhouettes = view_.smooth_silhouettes,
                               .specular = view_.specular,
                               .grain = view_.grain,
                               .neutral_sawn_faces = view_.neutral_sawn_faces,
                               .light_field = view_.light_field};
    picture_.set_appearance(look);
    std::optional<DrawnTool> tool;
    const SightElements elements = this->elements();
    if (start_ != nullptr && sight() == SessionSight::now) start_->page.note_bone_of_session();
    const bool shows_session = start_ == nullptr || !start_->hides_session(link_.status);
    const BoneTextures* bone = shows_session ? bone_.textures() : nullptr;
    const std::optional<ToolState> shown = elements.tool && shows_session ? tool_.shown() : std::nullopt;
    if (shown) tool = tool_.drawn(*shown, session(), operator_command_);
    picture_.draw(bone, tool ? &*tool : nullptr, camera_);
    const gl::Framebuffer* inset = draw_inset(tool, look);
    view_.scale = scale_that_fits(view_.scale, size_px_);
    panels_.begin(size_px_, picture_.eye_size_px(), elapsed_s, view_.theme, view_.scale);
    draw_overlay({.session = {.link = link_,
                              .info = source_.session(),
                              .tool = shown,
                              .operator_command = elements.controls ? operator_command_ : std::nullopt,
                              .sight = sight(),
                              .is_recording = source_.player() != nullptr},
                  .picture = {.frames_per_s = frame_s_ > 0.0 ? 1.0 / frame_s_ : 0.0,
                              .quality = picture_.quality(),
                              .preparation_percent = preparation_percent(),
                              .bone_problem = bone_.problem()},
                  .history = history_,
                  .camera = camera_,
                  .view = view_,
                  .slices = view_.slices_shown && shows_session ? &slices_ : nullptr,
                  .inset = inset,
                  .bone = source_.bone(),
                  .bone_version = bone_version_,
                  .is_bone_drawn = bone != nullptr,
                  .requests = takes_requests_ ? &requests_ : nullptr,
                  .start = start_,
                  .player = source_.player()},
                 size_px_);
    picture_.cover(panels_.end(picture_.pictures()));
    drawn_ = {link_, tool_.state(), operator_command_, preparation_percent()};
    drawn_sight_ = sight();
    has_undrawn_bone_ = false;
    return picture_.compose();
}

const gl::Framebuffer* SessionPicture::draw_inset(const std::optional<DrawnTool>& tool,
                                                  const SceneAppearance& look) {
    if (view_.inset == InsetKind::off) {
        inset_.reset();
        return nullptr;
    }
    if (!has_bone() || !tool) return nullptr;
    if (!inset_) inset_.emplace(renderer_choice_);
    return &inset_->draw(view_.inset, *bone_.textures(), *tool, look, inset_edge_px(glm::vec2(size_px_)));
}

void SessionPicture::resize(const glm::ivec2& size_px) {
    picture_.resize(size_px);
    size_px_ = picture_.size_px();
}

RenderReport SessionPicture::report() const {
    RenderReport report;
    report.gl_renderer = gl::renderer_name();
    if (const Bone* bone = source_.bone()) report.bone_checksum = checksum(*bone);
    if (has_bone()) report.textures = bone_.textures()->plan();
    report.dirty_bricks_uploaded = dirty_bricks_uploaded_;
    report.checksum_mismatches = link_.checksum_mismatches;
    report.link_status = link_.status_line;
    return report;
}

}  // namespace osteomill
