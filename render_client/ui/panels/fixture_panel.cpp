#include "render_client/ui/panels/fixture_panel.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "common/words/translation.h"
#include "render_client/ui/input/key_bindings.h"
#include "render_client/ui/panels/fixture_marks.h"
#include "render_client/ui/panels/widget_panel.h"

namespace osteomill {

namespace {

/// Distance from the burr to the place at which the fixture begins to act; nothing if it is not known.
std::optional<double> distance_mm(const SeenSession& session, const Fixture& fixture) {
    if (fixture.kind == FixtureKind::guide) {
        const glm::dvec3& burr_mm = session.tool->burr_position_mm;
        return std::max(0.0, glm::distance(burr_mm, nearest_of_path(fixture, burr_mm)) - fixture.radius_mm);
    }
    for (const StructureDistance& structure : session.link.distances)
        if (structure.distance_mm && session.info->tissues[structure.tissue].name == fixture.tissue)
            return *structure.distance_mm - fixture.distance_mm;
    return std::nullopt;
}

std::string acting_words(const Fixture& fixture, std::optional<double> distance_mm) {
    switch (fixture.kind) {
        case FixtureKind::guide:
            return trf("guides, {:.2f} mm off", distance_mm.value_or(0.0));
        case FixtureKind::forbidden:
            return trf("holds {} off", tissue_words(fixture.tissue));
        case FixtureKind::slow:
            break;
    }
    return tr("slows");
}

TextLine line_of(const SeenSession& session, const Fixture& fixture, bool is_on, bool acts) {
    const auto line = [&](Tone tone, const std::string& state) {
        return TextLine{{tone, fixture.name + ": " + state}};
    };
    if (!is_on) return line(Tone::dim, tr("off"));
    const std::optional<double> away_mm = distance_mm(session, fixture);
    if (acts) return line(Tone::good, acting_words(fixture, away_mm));
    if (away_mm) return line(Tone::plain, trf("{:.1f} mm away", std::max(*away_mm, 0.0)));
    return line(Tone::plain, tr("not near"));
}

}  // namespace

PanelText fixture_text(const SeenSession& session) {
    PanelText text;
    if (!session.info || !session.tool) return text;
    const std::vector<Fixture>& fixtures = session.info->fixtures;
    for (std::size_t i = 0; i < fixtures.size(); ++i)
        text.push_back(line_of(session, fixtures[i], has_fixture(session.tool->fixtures_on, i),
                               has_fixture(session.tool->fixtures_acting, i)));
    return text;
}

glm::vec2 fixture_panel_size(const PanelText& text) {
    const ImGuiStyle& style = ImGui::GetStyle();
    float width = 0.0f;
    for (const TextLine& line : text)
        width = std::max(width, ImGui::CalcTextSize(line.front().text.c_str()).x);
    return {
        std::ceil(width + ImGui::GetFrameHeight() + style.ItemInnerSpacing.x + 2.0f * style.WindowPadding.x),
        static_cast<float>(text.size()) * ImGui::GetFrameHeightWithSpacing() - style.ItemSpacing.y +
            2.0f * style.WindowPadding.y};
}

void draw_fixture_panel(const SeenSession& session, const Theme& theme, const PanelText& text,
                        const PanelPlace& place, SessionRequests& requests) {
    const WidgetPanel window("fixtures", place);
    const SessionStatus& can = session.link.controls;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const TextPiece& words = text[i].front();
        bool is_on = has_fixture(session.tool->fixtures_on, i);
        ImGui::PushID(static_cast<int>(i));
        ImGui::PushStyleColor(ImGuiCol_Text, colour_of(theme[words.tone]));
        ImGui::BeginDisabled(!can.is_paused || !can.may_control);
        // The words may have what Dear ImGui takes for a sign.
        if (ImGui::Checkbox("##on", &is_on))
            requests.controls.push_back(
                {.action = SessionAction::fixture, .text = session.info->fixtures[i].name, .is_on = is_on});
        ImGui::EndDisabled();
        const bool is_hovered = ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled);
        ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(words.text.c_str());
        ImGui::PopStyleColor();
        if (is_hovered)
            ImGui::SetTooltip(
                "%s",
                can.is_paused
                    ? tr("help by force, on or off")
                    : trf("pause first ({}): then it is switched on or off", key_of(Action::hold)).c_str());
        ImGui::PopID();
    }
}

}  // namespace osteomill
