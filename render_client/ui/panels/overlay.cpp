#include "render_client/ui/panels/overlay.h"

#include <functional>
#include <glm/common.hpp>

#include "render_client/ui/panels/cube_panel.h"
#include "render_client/ui/panels/cuts_panel.h"
#include "render_client/ui/panels/help_panel.h"
#include "render_client/ui/panels/inset_panel.h"
#include "render_client/ui/panels/live_plot.h"
#include "render_client/ui/panels/panel_painter.h"
#include "render_client/ui/panels/picture_marks.h"
#include "render_client/ui/panels/playback_panel.h"
#include "render_client/ui/panels/session_dialog.h"
#include "render_client/ui/panels/slices_panel.h"
#include "render_client/ui/panels/start_panel.h"
#include "render_client/ui/panels/structure_text.h"
#include "render_client/ui/panels/tissue_legend.h"
#include "render_client/ui/panels/tool_bar.h"
#include "render_client/ui/panels/transfer_panel.h"

namespace osteomill {

namespace {

constexpr float margin_px = 12.0f;  // at scale 1

using Draw = std::function<void(const PanelPlace&)>;

/// Wishes for places, and what to draw there: the most important first.
class PanelList {
  public:
    void add(Anchor anchor, std::vector<glm::vec2> sizes, Draw draw) {
        wishes_.push_back({.anchor = anchor, .sizes = std::move(sizes)});
        draws_.push_back(std::move(draw));
    }
    /// One that the user opened.
    void add_asked_for(Anchor anchor, const glm::vec2& size, Draw draw) {
        add(anchor, {size}, std::move(draw));
        wishes_.back().may_cover_middle = true;
    }
    void let_last_cover_middle() { wishes_.back().may_cover_middle = true; }
    void add_text(const PanelPainter& painter, Anchor anchor, const PanelText& text, float widest) {
        add(anchor, {painter.size_of(text, widest)},
            [&painter, text](const PanelPlace& place) { painter.draw(text, place); });
    }
    void draw_in(const glm::vec2& picture, float margin) const {
        const auto places = lay_out(wishes_, picture, margin);
        for (std::size_t i = 0; i < places.size(); ++i)
            if (places[i]) draws_[i](*places[i]);
    }

  private:
    std::vector<PanelWish> wishes_;
    std::vector<Draw> draws_;
};

void add_plot(PanelList& panels, const OverlayContent& content, const PanelPainter& painter) {
    std::vector<glm::vec2> sizes;
    for (const PlotDetail detail : {PlotDetail::all, PlotDetail::forces, PlotDetail::numbers})
        sizes.push_back(live_plot_size(painter, detail));
    panels.add(Anchor::lower_right, sizes, [&](const PanelPlace& place) {
        draw_live_plot(painter, *content.history, *content.tool, static_cast<PlotDetail>(place.choice),
                       place);
    });
}

void add_inset(PanelList& panels, const OverlayContent& content, const PanelPainter& painter,
               const glm::ivec2& size_px) {
    const bool is_known = content.session && content.tool->burr < content.session->burrs.size();
    const double diameter_mm = is_known ? content.session->burrs[content.tool->burr].diameter_mm : 0.0;
    const glm::dvec2 burr_px = pixel_of(*content.camera, content.tool->burr_position_mm, size_px);
    panels.add(inset_anchor(burr_px, glm::vec2(size_px)), {glm::vec2(content.inset->size_px())},
               [&, diameter_mm](const PanelPlace& place) {
                   draw_inset(painter, *content.inset, content.view->inset, diameter_mm, place);
               });
}

/// What the user works with.
void add_controls(PanelList& panels, const OverlayContent& content, const PanelPainter& painter,
                  const glm::vec2& picture, float side_width) {
    ViewSettings& view = *content.view;
    if (content.slices != nullptr) {
        panels.add(Anchor::lower_left, slices_panel_sizes(painter),
                   [&](const PanelPlace& place) { draw_slices_panel(content, painter, place); });
        panels.let_last_cover_middle();
    }
    if (view.cuts_panel_shown)
        panels.add_asked_for(Anchor::upper_left, cuts_panel_size(painter), [&](const PanelPlace& place) {
            draw_cuts_panel(view.cuts, *content.camera, place);
        });
    if (view.transfer_panel_shown)
        panels.add_asked_for(Anchor::upper_left, transfer_panel_size(painter), [&](const PanelPlace& place) {
            draw_transfer_panel(painter, view.transfer, place);
        });
    if (content.operator_command)
        panels.add_text(painter, Anchor::lower_left, operator_text(content), side_width);
    if (content.player != nullptr)
        panels.add(Anchor::lower_left, {playback_panel_size(painter, picture)},
                   [&](const PanelPlace& place) { draw_playback_panel(*content.player, place); });
}

/// What the user reads.
void add_readings(PanelList& panels, const OverlayContent& content, const PanelPainter& painter,
                  const glm::ivec2& size_px, float side_width) {
    if (content.tool) add_plot(panels, content, painter);
    panels.add_text(painter, Anchor::upper_left, session_text(content), side_width);
    if (content.tool) panels.add_text(painter, Anchor::upper_right, tool_text(content), side_width);
    if (const PanelText structures = structure_text(content); !structures.empty())
        panels.add_text(painter, Anchor::upper_right, structures, side_width);
    if (content.has_bone) {
        panels.add(Anchor::upper_right, {cube_size(painter)},
                   [&](const PanelPlace& place) { draw_cube(painter, *content.camera, place); });
        const ScaleBar bar = scale_bar_of(*content.camera, size_px);
        panels.add(Anchor::bottom, {scale_bar_size(painter, bar)},
                   [&painter, bar](const PanelPlace& place) { draw_scale_bar(painter, bar, place); });
    }
    // A transfer function puts other colours in place of the tissues'.
    if (content.session && !content.session->tissues.empty() && !content.view->transfer.function())
        panels.add(Anchor::upper_left, {legend_size(painter, content.session->tissues)},
                   [&](const PanelPlace& place) { draw_legend(painter, content.session->tissues, place); });
}

}  // namespace

void draw_overlay(const OverlayContent& content, const glm::ivec2& size_px) {
    const PanelPainter painter(theme_of(content.view->theme), content.view->scale);
    const glm::vec2 picture(size_px);
    if (content.tool && content.has_bone && content.view->panels_shown)
        draw_force_label(painter, *content.tool, *content.camera, size_px);
    draw_slices_cross(content, painter, size_px);
    const float margin = margin_px * painter.scale();
    const float side_width =
        glm::clamp(0.45f * picture.x, 200.0f * painter.scale(), 360.0f * painter.scale());
    PanelList panels;
    if (content.view->help_shown) {
        const Situation situation =
            situation_of(content.operator_command.has_value(), content.player != nullptr);
        panels.add_asked_for(
            Anchor::middle, help_size(painter, situation, picture - 2.0f * margin),
            [&painter, situation](const PanelPlace& place) { draw_help(painter, situation, place); });
    }
    // Before the warnings, which come and go: a button must not slip away under the pointer.
    if (content.view->panels_shown && has_tool_bar(content))
        panels.add(Anchor::top, tool_bar_sizes(content, painter),
                   [&](const PanelPlace& place) { draw_tool_bar(content, place); });
    if (const PanelText warnings = warning_text(content); !warnings.empty())
        panels.add_text(painter, Anchor::top, warnings, picture.x - 2.0f * margin);
    if (content.view->question != SessionQuestion::none && content.wishes != nullptr)
        panels.add_asked_for(Anchor::middle, session_dialog_size(content, painter),
                             [&](const PanelPlace& place) { draw_session_dialog(content, place); });
    if (content.start != nullptr && content.link.status == LinkStatus::finished)
        content.start->page.note_end_of_session();
    if (content.start != nullptr && content.start->is_due(content.link.status))
        panels.add_asked_for(Anchor::middle, start_panel_size(picture - 2.0f * margin),
                             [&](const PanelPlace& place) {
                                 draw_start_panel(content.start->page, content.start->picture, place);
                             });
    if (content.inset != nullptr && content.tool) add_inset(panels, content, painter, size_px);
    if (content.view->panels_shown) {
        add_controls(panels, content, painter, picture, side_width);
        add_readings(panels, content, painter, size_px, side_width);
    }
    panels.draw_in(picture, margin);
}

}  // namespace osteomill
