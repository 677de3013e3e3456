#include "render_client/ui/panels/overlay.h"

#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render_client/ui/panels/cuts_panel.h"
#include "render_client/ui/panels/fixture_panel.h"
#include "render_client/ui/panels/help_panel.h"
#include "render_client/ui/panels/inset_panel.h"
#include "render_client/ui/panels/live_plot.h"
#include "render_client/ui/panels/orientation_cube.h"
#include "render_client/ui/panels/panel_painter.h"
#include "render_client/ui/panels/panel_text.h"
#include "render_client/ui/panels/picture_marks.h"
#include "render_client/ui/panels/playback_panel.h"
#include "render_client/ui/panels/session_dialog.h"
#include "render_client/ui/panels/sight_panel.h"
#include "render_client/ui/panels/slices_panel.h"
#include "render_client/ui/panels/start_panel.h"
#include "render_client/ui/panels/tissue_legend.h"
#include "render_client/ui/panels/tool_bar.h"
#include "render_client/ui/panels/transfer_panel.h"

namespace osteomill {

namespace {

constexpr float margin_px = 12.0f;  // at scale 1
constexpr float banner_letters = 1.6f;

using Draw = std::function<void(const PanelPlace&)>;

/// Requests for places, and the drawings there: the most important first.
class PanelList {
  public:
    void add(Anchor anchor, std::vector<glm::vec2> sizes, Draw draw) {
        requests_.push_back({.anchor = anchor, .sizes = std::move(sizes)});
        draws_.push_back(std::move(draw));
    }
    /// A page or a question, which the user opened.
    void add_page(Anchor anchor, const glm::vec2& size, Draw draw) {
        add(anchor, {size}, std::move(draw));
        requests_.back().may_cover_middle = true;
    }
    void add_requested(Anchor anchor, std::vector<glm::vec2> sizes, Draw draw) {
        add(anchor, std::move(sizes), std::move(draw));
        requests_.back().is_requested = true;
    }
    void keep_last() { requests_.back().is_kept = true; }
    void let_last_give_way() { requests_.back().gives_way = true; }
    void add_text(const PanelPainter& painter, Anchor anchor, const PanelText& text, float widest,
                  float font_factor = 1.0f) {
        add(anchor, {painter.size_of(text, widest, font_factor)},
            [&painter, text, font_factor](const PanelPlace& place) {
                painter.draw(text, place, font_factor);
            });
    }
    /// Returns where they are.
    std::vector<std::optional<PanelPlace>> draw_in(const glm::vec2& picture, float margin,
                                                   const std::optional<PanelPlace>& burr) const {
        auto places = lay_out(requests_, picture, margin, burr);
        for (std::size_t i = 0; i < places.size(); ++i)
            if (places[i]) draws_[i](*places[i]);
        return places;
    }

  private:
    std::vector<PanelRequest> requests_;
    std::vector<Draw> draws_;
};

/// There is no session, or it is over. Its panels are not drawn, since they would cover the page.
bool shows_start_page(const OverlayContent& content) {
    return content.start != nullptr && content.start->is_due(content.session.link.status);
}

void add_plot(PanelList& panels, const OverlayContent& content, const PanelPainter& painter) {
    std::vector<glm::vec2> sizes;
    for (const PlotDetail detail : {PlotDetail::all, PlotDetail::forces, PlotDetail::numbers})
        sizes.push_back(live_plot_size(painter, detail, content.view.details_shown));
    panels.add(Anchor::lower_right, sizes, [&](const PanelPlace& place) {
        draw_live_plot(painter, content.history, *content.session.tool, static_cast<PlotDetail>(place.choice),
                       content.view.details_shown, place);
    });
}

void add_inset(PanelList& panels, const OverlayContent& content, const PanelPainter& painter,
               const glm::ivec2& size_px) {
    const Burr* burr = content.session.burr_in_tool();
    const double diameter_mm = burr ? burr->diameter_mm : 0.0;
    const glm::dvec2 burr_px = pixel_of(content.camera, content.session.tool->burr_position_mm, size_px);
    panels.add(inset_anchor(burr_px, glm::vec2(size_px)), {glm::vec2(content.inset->size_px())},
               [&, diameter_mm](const PanelPlace& place) {
                   draw_inset(painter, *content.inset, content.view.inset, diameter_mm, place);
               });
}

/// The panels that the user works with.
void add_controls(PanelList& panels, const OverlayContent& content, const PanelPainter& painter,
                  const glm::vec2& picture, float side_width) {
    ViewSettings& view = content.view;
    const auto shrunk = [&](const glm::vec2& whole) {
        return shrinking_sizes(whole, picture, margin_px * painter.scale(),
                               ImGui::GetFrameHeight() + 2.0f * ImGui::GetStyle().WindowPadding.y);
    };
    // First: the others are for a while, and none may take its place.
    if (content.player != nullptr && view.playback_shown)
        panels.add(Anchor::lower_left, {playback_panel_size(painter, picture)},
                   [&](const PanelPlace& place) { draw_playback_panel(*content.player, painter, place); });
    if (content.slices != nullptr) {
        std::vector<glm::vec2> sizes = slices_panel_sizes(painter);
        const auto smaller = shrunk(sizes.back());
        sizes.insert(sizes.end(), smaller.begin() + 1, smaller.end());
        panels.add_requested(Anchor::lower_left, std::move(sizes), [&](const PanelPlace& place) {
            draw_slices_panel(*content.slices, content.session, {content.bone, content.bone_version}, place,
                              content.requests);
        });
    }
    if (view.cuts_panel_shown)
        panels.add_requested(
            Anchor::upper_left, shrunk(cuts_panel_size(painter)),
            [&](const PanelPlace& place) { draw_cuts_panel(view.cuts, content.camera, place); });
    if (view.transfer_panel_shown)
        panels.add_requested(Anchor::upper_left, shrunk(transfer_panel_size(painter)),
                             [&](const PanelPlace& place) { draw_transfer_panel(painter, view, place); });
    if (content.session.operator_command)
        panels.add_text(painter, Anchor::lower_left, operator_text(content.session), side_width);
}

/// The panels that the user reads.
void add_readings(PanelList& panels, const OverlayContent& content, const PanelPainter& painter,
                  const glm::ivec2& size_px, float side_width) {
    // Length and force are read at any time, but not under a page or a question, which is to be seen whole.
    const bool is_page_open = content.view.help_shown || content.view.question != SessionQuestion::none;
    if (content.is_bone_drawn) {
        const ScaleBar bar = scale_bar_of(content.camera, size_px);
        panels.add(Anchor::bottom, {scale_bar_size(painter, bar)},
                   [&painter, bar](const PanelPlace& place) { draw_scale_bar(painter, bar, place); });
        if (!is_page_open) panels.keep_last();
    }
    if (content.session.tool) {
        add_plot(panels, content, painter);
        if (!is_page_open) panels.keep_last();
        panels.let_last_give_way();
    }
    const auto add_text = [&](Anchor anchor, const PanelText& text) {
        panels.add_text(painter, anchor, text, side_width);
        panels.let_last_give_way();
    };
    const SeenSession& session = content.session;
    const bool is_page_hidden = content.start != nullptr && content.start->is_hidden(session.link.status);
    add_text(Anchor::upper_left, session_text(session, content.picture, content.view, is_page_hidden));
    if (session.tool) add_text(Anchor::upper_right, tool_text(session, content.bone));
    if (const PanelText structures = structure_text(session); !structures.empty())
        add_text(Anchor::upper_right, structures);
    if (const PanelText fixtures = fixture_text(session); !fixtures.empty()) {
        if (content.requests != nullptr && session.takes_controls())
            panels.add(Anchor::upper_right, {fixture_panel_size(fixtures)},
                       [&, fixtures](const PanelPlace& place) {
                           draw_fixture_panel(session, painter.theme(), fixtures, place, *content.requests);
                       });
        else
            add_text(Anchor::upper_right, fixtures);
    }
    if (content.is_bone_drawn) {
        panels.add(Anchor::upper_right, {cube_size(painter)},
                   [&](const PanelPlace& place) { draw_cube(painter, content.camera, place); });
        panels.let_last_give_way();
    }
    // A transfer function puts other colours in place of the tissues'.
    if (session.info && !session.info->tissues.empty() && !content.view.transfer.function()) {
        panels.add(Anchor::upper_left, {legend_size(painter, session.info->tissues)},
                   [&](const PanelPlace& place) { draw_legend(painter, session.info->tissues, place); });
        panels.let_last_give_way();
    }
}

/// The part of the picture that the burr covers; none if the burr is not in it.
std::optional<PanelPlace> burr_in(const OverlayContent& content, const glm::ivec2& size_px) {
    const Burr* burr = content.session.burr_in_tool();
    if (burr == nullptr || !content.is_bone_drawn) return std::nullopt;
    const glm::dvec3& burr_mm = content.session.tool->burr_position_mm;
    if (!content.camera.has_in_front(burr_mm)) return std::nullopt;
    const auto radius =
        static_cast<float>(burr->radius_mm() / mm_per_px_at(content.camera, burr_mm, size_px));
    return PanelPlace{glm::vec2(pixel_of(content.camera, burr_mm, size_px)) - radius,
                      glm::vec2(2.0f * radius), 0};
}

}  // namespace

void draw_overlay(const OverlayContent& content, const glm::ivec2& size_px) {
    ViewSettings& view = content.view;
    const SeenSession& session = content.session;
    const PanelPainter painter(theme_of(view.theme), view.scale);
    const glm::vec2 picture(size_px);
    if (content.slices != nullptr) draw_slices_cross(*content.slices, content.camera, painter, size_px);
    if (session.tool && session.info && content.is_bone_drawn)
        draw_guides(painter, session, content.camera, size_px);
    const float margin = margin_px * painter.scale();
    const float side_width =
        glm::clamp(0.45f * picture.x, 200.0f * painter.scale(), 360.0f * painter.scale());
    PanelList panels;
    const bool starts = shows_start_page(content);
    const SightElements elements = elements_of(session.sight);
    if (elements.is_grey && content.is_bone_drawn) draw_veil(painter, size_px);
    if (view.help_shown) {
        const Situation situation =
            starts ? Situation::starting
            : session.is_recording || elements.controls
                ? situation_of(session.operator_command.has_value(), session.is_recording)
                : Situation::waiting;
        const HelpLayout help = lay_out_help(painter, situation, picture - 2.0f * margin);
        panels.add_page(Anchor::middle, help.size,
                        [&painter, help](const PanelPlace& place) { draw_help(painter, help, place); });
    }
    if (content.start != nullptr && session.link.status == LinkStatus::finished)
        content.start->page.note_end_of_session();
    if (starts)
        panels.add_page(Anchor::middle, start_panel_size(content.start->page, picture - 2.0f * margin),
                        [&](const PanelPlace& place) {
                            draw_start_panel(content.start->page, content.start->picture, place, view,
                                             content.requests);
                        });
    if (elements.has_words && !starts && !view.help_shown && view.question == SessionQuestion::none) {
        StartPage* const page = content.start != nullptr ? &content.start->page : nullptr;
        const bool is_own = page != nullptr && !page->may_start();  // and it has not ended yet
        const bool stands_still =
            is_own && session.sight == SessionSight::lost && session.link.status == LinkStatus::lost;
        // Nobody named a server: that none answers is no news.
        const bool has_none = page != nullptr && !is_own && content.start->is_hidden(session.link.status) &&
                              page->link_line.empty();
        const bool has_buttons =
            content.requests != nullptr && (session.sight == SessionSight::none || has_none || stands_still);
        const auto buttons =
            has_buttons ? std::optional(SightButtons{*content.requests, page, stands_still}) : std::nullopt;
        const SightWords words = has_none
                                     ? words_without_session()
                                     : words_of_sight(session, content.picture.preparation_percent, is_own);
        panels.add_page(Anchor::middle, sight_panel_size(words, has_buttons, picture - 2.0f * margin),
                        [=](const PanelPlace& place) { draw_sight_panel(words, buttons, place); });
    }
    // Before the warnings, which come and go: a button must not slip away under the pointer.
    const bool shows_panels = view.panels_shown && !starts;
    if (shows_panels && content.requests != nullptr && session.takes_controls())
        panels.add(Anchor::top, tool_bar_sizes(session, view),
                   [&](const PanelPlace& place) { draw_tool_bar(session, view, place, *content.requests); });
    const bool alarms = is_alarm(session) && !starts;
    // A fault harms no structure, so its banner looks different.
    if (alarms && !structure_warnings(session).empty()) draw_alarm_frame(painter, size_px);
    if (const PanelText warnings = starts ? notice_text(view.notice)
                                          : warning_text(session, content.picture.bone_problem, view.notice);
        !warnings.empty())
        panels.add_text(painter, Anchor::top, warnings, picture.x - 2.0f * margin,
                        alarms ? banner_letters : 1.0f);
    if (view.question != SessionQuestion::none && content.requests != nullptr && !starts) {
        const SessionAtHand at_hand = content.start != nullptr && content.start->page.is_session_running()
                                          ? SessionAtHand::own
                                          : SessionAtHand::of_others;
        panels.add_page(Anchor::middle, session_dialog_size(view, at_hand),
                        [&, at_hand](const PanelPlace& place) {
                            draw_session_dialog(view, at_hand, place, *content.requests);
                        });
    }
    if (content.inset != nullptr && session.tool && !starts) add_inset(panels, content, painter, size_px);
    if (shows_panels) {
        add_controls(panels, content, painter, picture, side_width);
        add_readings(panels, content, painter, size_px, side_width);
    }
    if (session.tool && content.is_bone_drawn && content.bone && session.operator_command && !starts)
        if (const auto ring = touch_ring(*content.bone, *session.tool, session.burr_radius_mm(),
                                         content.camera.eye_mm(), view.cuts.planes()))
            draw_touch_ring(painter, *ring, content.camera, size_px);
    const auto places = panels.draw_in(picture, margin, burr_in(content, size_px));
    if (session.tool && content.is_bone_drawn && shows_panels)
        draw_force_label(painter, *session.tool, session.burr_radius_mm(), content.camera, size_px, places);
}

}  // namespace osteomill
