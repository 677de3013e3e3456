#include "render_client/ui/panels/panel_text.h"

#include <fmt/format.h>

#include "common/words/translation.h"
#include "render_client/ui/input/key_bindings.h"
#include "render_client/ui/panels/fault_remedy.h"
#include "render_client/ui/panels/start_panel.h"
#include "render_client/ui/panels/structure_text.h"
#include "render_client/volume/bone_ahead.h"

namespace osteomill {

namespace {

TextLine line(Tone tone, std::string text) {
    return {{tone, std::move(text)}};
}

std::string quality_in_words(const PictureQuality& quality) {
    if (quality.refined) return tr("full quality");
    if (quality.scale == 1.0) return tr("refining");
    return trf("coarse, {:.0f} %", 100.0 * quality.scale);
}

bool has_problem(LinkStatus status) {
    return status == LinkStatus::connecting || status == LinkStatus::lost || status == LinkStatus::refused;
}

/// How much of a bone that is on its way has come.
std::string received_part(const LinkUpdate& link) {
    if (link.status != LinkStatus::receiving_snapshot || link.snapshot_bricks_total == 0) return {};
    return fmt::format(": {} %", std::uint64_t{100} * link.snapshot_bricks / link.snapshot_bricks_total);
}

void add_details(const OverlayContent& content, PanelText& text) {
    text.push_back(line(Tone::dim, trf("picture {:.0f} frames/s, {}", content.render_frames_per_s,
                                       quality_in_words(content.quality))));
    text.push_back(
        line(Tone::dim, trf("{} {:.0f} frames/s, {:.1f} kB/s", content.player ? tr("file") : tr("link"),
                            content.link.frames_per_s, 1e-3 * content.link.bytes_per_s)));
    if (const auto& delay = content.link.delay)
        text.push_back(line(Tone::dim, trf("delay {:.0f} ms by the clocks, {:.0f} over the least",
                                           1e3 * delay->by_clocks_s, 1e3 * delay->over_least_s)));
}

/// The fault, and its remedy.
void add_fault(const std::string& fault, PanelText& text) {
    text.push_back(line(Tone::warning, trf("FAULT: {}", tr(fault))));
    text.push_back(line(Tone::plain, tr(remedy_of(fault))));
}

}  // namespace

PanelText session_text(const OverlayContent& content) {
    PanelText text;
    if (content.session) {
        text.push_back(line(Tone::plain, tr(content.session->scene_name)));
        const auto scale = content.session->settings.find("force_scale");
        if (scale != content.session->settings.end())
            text.push_back(line(Tone::warning, tr("forces of cutting times ") + scale->second));
    }
    // "Connected" would contradict the words in the middle.
    if (content.sight != SessionSight::silent)
        text.push_back(line(has_problem(content.link.status) ? Tone::warning : Tone::plain,
                            content.link.status_line + received_part(content.link)));
    if (content.preparation_percent)
        text.push_back(line(Tone::plain, trf("preparing the bone: {} %", *content.preparation_percent)));
    if (content.view->details_shown) add_details(content, text);
    if (const std::uint64_t bad = content.link.checksum_mismatches + content.link.rejected_frames; bad > 0)
        text.push_back(line(
            Tone::warning, trf("{} bad frames; {} bricks were repaired", bad, content.link.bricks_repaired)));
    if (content.start != nullptr && content.start->is_hidden(content.link.status))
        text.push_back(line(Tone::plain, trf("{}: back to the cases", key_of(Action::end))));
    // In a film nobody can press it.
    if (!content.view->help_shown && content.view->playback_shown)
        text.push_back(line(Tone::dim, trf("{} help", key_of(Action::help))));
    return text;
}

PanelText tool_text(const OverlayContent& content) {
    const ToolState& tool = *content.tool;
    PanelText text;
    if (const Burr* in_tool = content.burr_in_tool()) {
        const Burr& burr = *in_tool;
        const std::string head =
            burr.is_ball() ? tr("burr")
                           : tr(std::string(head_shape_names[static_cast<std::size_t>(burr.head.shape)]));
        text.push_back(line(Tone::plain, trf("{} {:.1f} mm, {} edges", head, burr.diameter_mm, burr.edges)));
        text.push_back(tool.spindle_on ? line(Tone::good, trf("spindle {:.0f} rpm", spindle_rpm(tool, burr)))
                                       : line(Tone::dim, tr("spindle off")));
    }
    if (content.operator_command && content.bone != nullptr)
        if (const auto ahead_mm = bone_ahead_mm(*content.bone, tool, content.burr_radius_mm()))
            text.push_back(line(Tone::plain, trf("{:.1f} mm to the bone", *ahead_mm)));
    text.push_back(line(Tone::plain, trf("removed {:.2f} mm\u00b3", tool.removed_mm3)));
    text.push_back(line(Tone::dim, trf("time {:.1f} s", tool.time_s)));
    return text;
}

PanelText warning_text(const OverlayContent& content) {
    PanelText text;
    if (!content.bone_problem.empty()) text.push_back(line(Tone::warning, content.bone_problem));
    if (!content.link.recording_error.empty())
        text.push_back(line(Tone::warning, content.link.recording_error));
    if (content.link.controls.is_paused && elements_of(content.sight).controls)
        text.push_back(line(Tone::plain, tr("paused: force and spindle off")));
    else if (content.tool && !content.tool->fault.empty())
        add_fault(std::string(content.tool->fault.text()), text);
    if (content.tool && !content.tool->notice.empty())
        text.push_back(line(Tone::plain, tr_filled(std::string(content.tool->notice.text()))));
    if (content.tool && content.tool->driver == ToolDriver::others_only)
        text.push_back(
            line(Tone::plain, tr("you watch: the server does not list this client as an operator")));
    const PanelText structures = structure_warnings(content);
    text.insert(text.end(), structures.begin(), structures.end());
    const PanelText notice = notice_text(content);
    text.insert(text.end(), notice.begin(), notice.end());
    return text;
}

PanelText notice_text(const OverlayContent& content) {
    if (content.view->notice.empty()) return {};
    return {line(Tone::plain, content.view->notice)};
}

bool is_alarm(const OverlayContent& content) {
    const bool has_fault = content.tool && !content.tool->fault.empty() && !content.link.controls.is_paused;
    return has_fault || !structure_warnings(content).empty();
}

PanelText operator_text(const OverlayContent& content) {
    PanelText text;
    if (content.tool && content.tool->driver == ToolDriver::another)
        text.push_back(
            line(Tone::warning, tr("another client moves the tool; ask again when it has let go")));
    text.push_back(content.operator_command->pedal ? line(Tone::good, tr("pedal down"))
                                                   : line(Tone::dim, tr("pedal up (SPACE)")));
    if (content.tool && content.tool->removed_mm3 == 0.0) {
        text.push_back(
            line(Tone::plain, tr("1. Drag with the left mouse button: the burr goes over the bone.")));
        text.push_back(line(Tone::plain, tr("2. Hold SPACE: the burr turns.")));
        text.push_back(line(Tone::plain, tr("3. The wheel, or W, pushes it into the bone; S pulls it out.")));
        text.push_back(line(Tone::plain, trf("Right drag turns the view, ctrl + wheel zooms. {}: all keys.",
                                             key_of(Action::help))));
    } else {
        text.push_back(line(Tone::dim, trf("left drag: hand   wheel, W/S: in/out   1-9 {} {}: burr",
                                           key_of(Action::previous_burr), key_of(Action::next_burr))));
    }
    return text;
}

}  // namespace osteomill
