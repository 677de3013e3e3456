#include "render_client/ui/overlay.h"

#include <fmt/format.h>

#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render_client/ui/cube_panel.h"
#include "render_client/ui/cuts_panel.h"
#include "render_client/ui/help_panel.h"
#include "render_client/ui/live_plot.h"
#include "render_client/ui/panel_painter.h"
#include "render_client/ui/picture_marks.h"
#include "render_client/ui/playback_panel.h"
#include "render_client/ui/tissue_legend.h"

namespace osteomill {

namespace {

constexpr float margin_px = 12.0f;  // at scale 1

/// A wish for a place, and what to draw there.
struct Panel {
    PanelWish wish;
    std::function<void(const PanelPlace&)> draw;
};

Panel text_panel(const PanelPainter& painter, Anchor anchor, const PanelText& text, float widest) {
    return {{anchor, {painter.size_of(text, widest)}},
            [&painter, text](const PanelPlace& place) { painter.draw(text, place); }};
}

Panel plot_panel(const PanelPainter& painter, const OverlayContent& content) {
    std::vector<glm::vec2> sizes;
    for (const PlotDetail detail : {PlotDetail::all, PlotDetail::forces, PlotDetail::numbers})
        sizes.push_back(live_plot_size(painter, detail));
    return {{Anchor::lower_right, sizes}, [&](const PanelPlace& place) {
                draw_live_plot(painter, *content.history, *content.tool,
                               static_cast<PlotDetail>(place.choice), place);
            }};
}

/// The most important first: in a small window those at the end are left out.
std::vector<Panel> panels_of(const OverlayContent& content, const PanelPainter& painter,
                             const glm::vec2& picture) {
    ViewSettings& view = *content.view;
    const float margin = margin_px * painter.scale();
    const float whole_width = picture.x - 2.0f * margin;
    const float side_width =
        glm::clamp(0.45f * picture.x, 200.0f * painter.scale(), 360.0f * painter.scale());
    std::vector<Panel> panels;
    if (const PanelText warnings = warning_text(content); !warnings.empty())
        panels.push_back(text_panel(painter, Anchor::top, warnings, whole_width));
    if (!view.panels_shown && !view.help_shown) return panels;
    if (view.help_shown) {
        const Situation situation =
            situation_of(content.operator_intent.has_value(), content.player != nullptr);
        panels.push_back(
            {help_wish(painter, situation, picture - 2.0f * margin),
             [&painter, situation](const PanelPlace& place) { draw_help(painter, situation, place); }});
    }
    if (!view.panels_shown) return panels;
    if (content.operator_intent)
        panels.push_back(text_panel(painter, Anchor::lower_left, operator_text(content), side_width));
    if (content.player != nullptr)
        panels.push_back({{Anchor::lower_left, {playback_panel_size(painter, picture)}},
                          [&](const PanelPlace& place) { draw_playback_panel(*content.player, place); }});
    if (view.cuts_panel_shown)
        panels.push_back({{Anchor::upper_left, {cuts_panel_size(painter)}}, [&](const PanelPlace& place) {
                              draw_cuts_panel(view.cuts, *content.camera, place);
                          }});
    if (content.tool) panels.push_back(plot_panel(painter, content));
    panels.push_back(text_panel(painter, Anchor::upper_left, session_text(content), side_width));
    if (content.tool)
        panels.push_back(text_panel(painter, Anchor::upper_right, tool_text(content), side_width));
    if (content.has_bone) {
        panels.push_back({{Anchor::upper_right, {cube_size(painter)}},
                          [&](const PanelPlace& place) { draw_cube(painter, *content.camera, place); }});
        const ScaleBar bar = scale_bar_of(*content.camera, glm::ivec2(picture));
        panels.push_back({{Anchor::bottom, {scale_bar_size(painter, bar)}},
                          [&painter, bar](const PanelPlace& place) { draw_scale_bar(painter, bar, place); }});
    }
    if (content.session && !content.session->tissues.empty())
        panels.push_back(
            {{Anchor::upper_left, {legend_size(painter, content.session->tissues)}},
             [&](const PanelPlace& place) { draw_legend(painter, content.session->tissues, place); }});
    return panels;
}

}  // namespace

void draw_overlay(const OverlayContent& content, const glm::ivec2& size_px) {
    const PanelPainter painter(theme_of(content.view->theme), content.view->scale);
    const glm::vec2 picture(size_px);
    if (content.tool && content.has_bone && content.view->panels_shown)
        draw_force_label(painter, *content.tool, *content.camera, size_px);
    const std::vector<Panel> panels = panels_of(content, painter, picture);
    std::vector<PanelWish> wishes;
    for (const Panel& panel : panels) wishes.push_back(panel.wish);
    const auto places = lay_out(wishes, picture, margin_px * painter.scale());
    for (std::size_t i = 0; i < panels.size(); ++i)
        if (places[i]) panels[i].draw(*places[i]);
}

}  // namespace osteomill
