#include "render_client/ui/panels/panel_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/words/translation.h"
#include "render_client/ui/input/key_bindings.h"
#include "render_client/ui/panels/fault_remedy.h"
#include "render_client/volume/surface_points.h"

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

void add_details(const SeenSession& session, const PictureProgress& picture, PanelText& text) {
    text.push_back(line(Tone::dim, trf("picture {:.0f} frames/s, {}", picture.frames_per_s,
                                       quality_in_words(picture.quality))));
    text.push_back(
        line(Tone::dim, trf("{} {:.0f} frames/s, {:.1f} kB/s", session.is_recording ? tr("file") : tr("link"),
                            session.link.frames_per_s, 1e-3 * session.link.bytes_per_s)));
    if (const auto& delay = session.link.delay)
        text.push_back(line(Tone::dim, trf("delay {:.0f} ms by the clocks, {:.0f} over the least",
                                           1e3 * delay->by_clocks_s, 1e3 * delay->over_least_s)));
}

/// The nearest cause in a few words; the warnings say it in full.
const char* why_spindle_is_off(const SeenSession& session) {
    const ToolState& tool = *session.tool;
    if (session.link.controls.is_paused) return tr("spindle off: paused");
    if (!tool.fault.empty()) return tr("spindle off: fault");
    // A recording, or a server's own device, does not say where its pedal is.
    if (!session.operator_command) return tr("spindle off");
    if (tool.driver == ToolDriver::another) return tr("spindle off: another has the tool");
    if (!session.operator_command->pedal) return tr("spindle off: the pedal is up");
    const bool awaits_release = tool.notice.text().starts_with("the spindle stays off");
    return awaits_release ? tr("spindle off: press the pedal anew") : tr("spindle off");
}

/// The fault, and its remedy.
void add_fault(const std::string& fault, PanelText& text) {
    text.push_back(line(Tone::warning, trf("FAULT: {}", tr(fault))));
    text.push_back(line(Tone::plain, tr(remedy_of(fault))));
}

}  // namespace

PanelText session_text(const SeenSession& session, const PictureProgress& picture, const ViewSettings& view,
                       bool is_page_hidden) {
    PanelText text;
    if (session.info) {
        text.push_back(line(Tone::plain, tr(session.info->scene_name)));
        const auto scale = session.info->settings.find("force_scale");
        if (scale != session.info->settings.end())
            text.push_back(line(Tone::warning, tr("forces of cutting times ") + scale->second));
    }
    // "Connected" would contradict the words in the middle; and beside a hidden page nobody waits for a
    // server.
    if (session.sight != SessionSight::silent && !(is_page_hidden && has_problem(session.link.status)))
        text.push_back(line(has_problem(session.link.status) ? Tone::warning : Tone::plain,
                            session.link.status_line + received_part(session.link)));
    if (picture.preparation_percent)
        text.push_back(line(Tone::plain, trf("preparing the bone: {} %", *picture.preparation_percent)));
    if (view.details_shown) add_details(session, picture, text);
    if (const std::uint64_t bad = session.link.checksum_mismatches + session.link.rejected_frames; bad > 0)
        text.push_back(line(
            Tone::warning, trf("{} bad frames; {} bricks were repaired", bad, session.link.bricks_repaired)));
    if (is_page_hidden) text.push_back(line(Tone::plain, trf("{}: back to the cases", key_of(Action::end))));
    // In a film nobody can press it.
    if (!view.help_shown && view.playback_shown)
        text.push_back(line(Tone::dim, trf("{} help", key_of(Action::help))));
    return text;
}

PanelText tool_text(const SeenSession& session, const Bone* bone) {
    const ToolState& tool = *session.tool;
    PanelText text;
    if (const Burr* in_tool = session.burr_in_tool()) {
        const Burr& burr = *in_tool;
        const std::string head =
            burr.is_ball() ? tr("burr")
                           : tr(std::string(head_shape_names[static_cast<std::size_t>(burr.head.shape)]));
        text.push_back(line(Tone::plain, trf("{} {:.1f} mm, {} edges", head, burr.diameter_mm, burr.edges)));
        text.push_back(tool.spindle_on ? line(Tone::good, trf("spindle {:.0f} rpm", spindle_rpm(tool, burr)))
                                       : line(Tone::dim, why_spindle_is_off(session)));
    }
    if (session.operator_command && bone != nullptr) {
        // In a cavity there may be bone at its side and none for some way ahead.
        const auto ahead_mm = bone_ahead_mm(*bone, tool, session.burr_radius_mm());
        if (tool.depth_mm.value_or(0.0) > 0.0)
            text.push_back(line(Tone::plain, tr("in touch with bone")));
        else if (ahead_mm)
            text.push_back(line(Tone::plain, trf("{:.1f} mm to the bone ahead", *ahead_mm)));
    }
    text.push_back(line(Tone::plain, trf("removed {:.2f} mm\u00b3", tool.removed_mm3)));
    text.push_back(line(Tone::dim, trf("time {:.1f} s", tool.time_s)));
    return text;
}

PanelText warning_text(const SeenSession& session, const std::string& bone_problem,
                       const std::string& notice) {
    PanelText text;
    if (!bone_problem.empty()) text.push_back(line(Tone::warning, bone_problem));
    if (!session.link.recording_error.empty())
        text.push_back(line(Tone::warning, session.link.recording_error));
    if (const std::string& problem = session.link.controls.recording_problem; !problem.empty()) {
        text.push_back(line(Tone::warning, trf("NOT RECORDED: {}", tr_about_file(problem))));
        text.push_back(
            line(Tone::plain, tr("Make room on the server's disk: the recording then goes on by itself, "
                                 "with nothing missing from the bone. The session goes on meanwhile.")));
    }
    if (session.link.controls.is_paused && elements_of(session.sight).controls)
        text.push_back(line(Tone::plain, tr("paused: force and spindle off")));
    else if (session.tool && !session.tool->fault.empty())
        add_fault(std::string(session.tool->fault.text()), text);
    if (session.tool && !session.tool->notice.empty())
        text.push_back(line(Tone::plain, tr_filled(std::string(session.tool->notice.text()))));
    if (session.tool && session.tool->driver == ToolDriver::others_only)
        text.push_back(
            line(Tone::plain, tr("you watch: the server does not list this client as an operator")));
    const PanelText structures = structure_warnings(session);
    text.insert(text.end(), structures.begin(), structures.end());
    const PanelText notices = notice_text(notice);
    text.insert(text.end(), notices.begin(), notices.end());
    return text;
}

PanelText notice_text(const std::string& notice) {
    if (notice.empty()) return {};
    return {line(Tone::plain, notice)};
}

bool is_alarm(const SeenSession& session) {
    const bool has_fault = session.tool && !session.tool->fault.empty() && !session.link.controls.is_paused;
    return has_fault || !structure_warnings(session).empty();
}

PanelText operator_text(const SeenSession& session) {
    PanelText text;
    if (session.tool && session.tool->driver == ToolDriver::another)
        text.push_back(
            line(Tone::warning, tr("another client moves the tool; ask again when it has let go")));
    text.push_back(session.operator_command->pedal ? line(Tone::good, tr("pedal down"))
                                                   : line(Tone::dim, tr("pedal up (SPACE)")));
    if (session.tool && session.tool->removed_mm3 == 0.0) {
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

namespace {

/// Two lines, so that none is too long for a panel.
void add_touches(PanelText& text, const StructureDistance& now, const Tissue& tissue) {
    const bool is_one = now.touches_so_far == 1;
    text.push_back({{Tone::warning,
                     is_one ? trf("touched: {}", tissue_words(tissue.name))
                            : trf("touched: {}, {} times", tissue_words(tissue.name), now.touches_so_far)}});
    std::string when = is_one
                           ? trf("at {:.1f} s, for {:.1f} s", now.first_touch_s, now.touched_s)
                           : trf("first at {:.1f} s, for {:.1f} s in all", now.first_touch_s, now.touched_s);
    if (now.removed_mm3 > 0.0)
        when += trf(", {:.2f} mm³ milled", now.removed_mm3);
    else if (now.entered_mm3 > 0.0)
        when += trf(", {:.2f} mm³ entered, none of it missing now", now.entered_mm3);
    text.push_back({{Tone::plain, std::move(when)}});
}

}  // namespace

PanelText structure_text(const SeenSession& session) {
    PanelText text;
    if (!session.info || !session.tool) return text;
    const std::vector<Tissue>& tissues = session.info->tissues;
    if (std::ranges::none_of(tissues, &Tissue::is_protected)) return text;
    if (const StructureDistance* nearest = nearest_structure(session.link.distances)) {
        const Tissue& tissue = tissues[nearest->tissue];
        text.push_back({{warning_of(*nearest, tissue) != StructureWarning::none ? Tone::warning : Tone::plain,
                         *nearest->distance_mm <= 0.0
                             ? trf("{}: touching", tissue_words(tissue.name))
                             : trf("{}: {:.2f} mm away", tissue_words(tissue.name), *nearest->distance_mm)}});
    } else {
        text.push_back({{Tone::dim, tr("no protected structure near")}});
    }
    for (const StructureDistance& now : session.link.distances)
        if (now.touches_so_far > 0) add_touches(text, now, tissues[now.tissue]);
    return text;
}

PanelText structure_warnings(const SeenSession& session) {
    PanelText text;
    if (!session.info || !elements_of(session.sight).tool) return text;
    for (const StructureDistance& now : session.link.distances) {
        const Tissue& tissue = session.info->tissues[now.tissue];
        if (now.touches)
            text.push_back({{Tone::warning,
                             trf("PROTECTED: the burr touches {}: pull back", tissue_words(tissue.name))}});
        else if (warning_of(now, tissue) == StructureWarning::near)
            text.push_back({{Tone::warning, trf("CAREFUL: {} is {:.1f} mm away: go slowly",
                                                tissue_words(tissue.name), *now.distance_mm)}});
    }
    if (text.empty() && session.tool && session.tool->touches_protected)
        text.push_back({{Tone::warning, tr("PROTECTED TISSUE: the burr touches it: pull back")}});
    return text;
}

}  // namespace osteomill
