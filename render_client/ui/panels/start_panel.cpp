#include "render_client/ui/panels/start_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "common/scene/material.h"
#include "render_client/ui/panels/case_card.h"
#include "render_client/ui/panels/input_panel.h"
#include "render_client/ui/words/translation.h"

namespace osteomill {

namespace {

void text_field(const char* label, std::string& text, float width) {
    std::array<char, 64> buffer{};
    text.copy(buffer.data(), buffer.size() - 1);
    ImGui::SetNextItemWidth(width);
    if (ImGui::InputText(label, buffer.data(), buffer.size())) text = buffer.data();
}

void number_field(const char* label, double& number, const char* format) {
    // Six of them stand in a row, with words for two more.
    const float letter = ImGui::GetFontSize();
    ImGui::SetNextItemWidth(std::clamp((ImGui::GetWindowContentRegionMax().x - 12.0f * letter) / 6.0f,
                                       3.0f * letter, 5.0f * letter));
    ImGui::InputDouble(label, &number, 0.0, 0.0, format);
}

bool button(const char* text, bool is_enabled) {
    ImGui::BeginDisabled(!is_enabled);
    const bool pressed = ImGui::Button(text);
    ImGui::EndDisabled();
    return pressed;
}

/// Room for a list above `lines` of other widgets.
ImVec2 list_size(float lines) {
    return {0.0f, ImGui::GetContentRegionAvail().y - lines * ImGui::GetFrameHeightWithSpacing()};
}

void draw_message(const StartPage& page) {
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(page.message().c_str());
    ImGui::PopTextWrapPos();
}

void draw_sessions(StartPage& page) {
    constexpr std::size_t most_shown = 20;
    for (std::size_t i = 0; i < std::min(page.sessions().size(), most_shown); ++i) {
        const std::filesystem::path session = page.sessions()[i];
        ImGui::PushID(static_cast<int>(i));
        std::error_code ignored;
        if (button(tr("Report"), std::filesystem::exists(session / "report.html", ignored)))
            page.open_report_of(session);
        ImGui::SameLine();
        if (ImGui::Button(tr("Replay"))) page.replay(session / "session.pcap");
        ImGui::SameLine();
        ImGui::TextUnformatted(session.filename().c_str());
        ImGui::PopID();
    }
}

void draw_cases(StartPage& page, StartPicture& pictures) {
    const float letter = ImGui::GetFontSize();
    ImGui::TextUnformatted(tr("Choose a case: drill it with the mouse, for as long as you like."));
    ImGui::TextDisabled("%s", tr("Forces are those of milling bone; at the end there is a report."));
    ImGui::BeginChild("cases", list_size(page.sessions().empty() ? 4.0f : 8.0f), true,
                      ImGuiWindowFlags_NavFlattened);
    const float room = ImGui::GetContentRegionAvail().x;
    const int columns = room > 44.0f * letter ? 2 : 1;
    const float between = ImGui::GetStyle().ItemSpacing.x;
    const ImVec2 card{(room - static_cast<float>(columns - 1) * between) / static_cast<float>(columns),
                      7.6f * letter};
    for (std::size_t i = 0; i < page.cases().size(); ++i) {
        if (i % static_cast<std::size_t>(columns) != 0) ImGui::SameLine();
        draw_case_card(page, pictures.of_cases, i, card);
    }
    ImGui::EndChild();
    if (!page.sessions().empty()) {
        ImGui::TextUnformatted(tr("Sessions so far"));
        ImGui::BeginChild("sessions", list_size(4.0f), true, ImGuiWindowFlags_NavFlattened);
        draw_sessions(page);
        ImGui::EndChild();
    }
    if (button(tr("Start"), !page.is_session_running())) page.start();
    ImGui::SameLine();
    text_field(tr("trainee"), page.trainee, 14.0f * letter);
    if (button(tr("Import a scan ..."), !page.is_session_running())) page.show(StartPage::View::scan_browser);
    ImGui::SameLine();
    if (button(tr("Import labels ..."), !page.is_session_running()))
        page.show(StartPage::View::labels_browser);
    ImGui::SameLine();
    if (ImGui::Button(tr("Open a recording ..."))) page.show(StartPage::View::recording_browser);
    if (button(tr("Compare all sessions"), !page.is_working() && !page.sessions().empty()))
        page.compare_sessions();
    ImGui::SameLine();
    if (button(tr("Open its report"), page.report().has_value())) page.open_report();
    ImGui::SameLine();
    if (ImGui::Button(tr("Hide this"))) page.is_hidden = true;
    draw_message(page);
}

void draw_browser(StartPage& page) {
    const bool is_for_scan =
        page.view() == StartPage::View::scan_browser || page.view() == StartPage::View::labels_browser;
    ImGui::TextUnformatted(
        is_for_scan
            ? tr("A DICOM folder, a NRRD, NIfTI or MetaImage file, or a folder of PNG or TIFF pictures")
        : page.view() == StartPage::View::colours_browser
            ? tr("Names and colours of labels: a table of 3D Slicer (.ctbl, .csv) or ITK-SNAP")
        : page.view() == StartPage::View::recording_browser
            ? tr("A recording of a session (.pcap)")
            : tr("A segmentation (.seg.nrrd, DICOM), or a label map"));
    ImGui::TextDisabled("%s", page.listing().folder.c_str());
    const FolderListing listing = page.listing();  // a click replaces it
    ImGui::BeginChild("files", list_size(2.0f), true);
    if (listing.folder.has_parent_path() && ImGui::Selectable(tr("../  (up)")))
        page.browse(listing.folder.parent_path());
    for (const std::string& name : listing.folders)
        if (ImGui::Selectable((name + "/").c_str())) page.browse(listing.folder / name);
    for (const std::string& name : listing.files)
        if (ImGui::Selectable(name.c_str())) page.take(listing.folder / name);
    ImGui::EndChild();
    if (!listing.problem.empty()) ImGui::TextUnformatted(listing.problem.c_str());
    if (is_for_scan) {
        if (button(tr("This folder"), !listing.files.empty())) page.take(listing.folder);
        ImGui::SameLine();
    }
    const bool was_on_import = !is_for_scan && page.view() != StartPage::View::recording_browser;
    if (ImGui::Button(tr("Back")))
        page.show(was_on_import ? StartPage::View::import : StartPage::View::cases);
}

void upload(const StartPage& page, StartPicture& picture) {
    const std::optional<double> threshold_hu =
        page.form.are_labels ? std::nullopt : std::optional(page.form.threshold_hu);
    if (picture.number == page.picture_number() && picture.threshold_hu == threshold_hu && picture.texture)
        return;
    if (!picture.texture) picture.texture.emplace();
    picture.texture->upload(
        threshold_hu ? with_contour(*page.picture(), *page.look(), preview_mm_per_px, *threshold_hu)
                     : *page.picture());
    picture.number = page.picture_number();
    picture.threshold_hu = threshold_hu;
}

void draw_letters(ImDrawList& canvas, const PreviewSlice& slice, const ImVec2& low, const ImVec2& high) {
    const float letter = ImGui::GetFontSize();
    const ImVec2 middle{0.5f * (low.x + high.x) - 0.3f * letter, 0.5f * (low.y + high.y) - 0.5f * letter};
    const std::array places{ImVec2{low.x + 0.2f * letter, middle.y}, ImVec2{high.x - 0.8f * letter, middle.y},
                            ImVec2{middle.x, low.y}, ImVec2{middle.x, high.y - letter}};
    const auto letters = letters_of(slice);
    for (std::size_t edge = 0; edge < letters.size(); ++edge) {
        canvas.AddText({places[edge].x + 1.0f, places[edge].y + 1.0f}, IM_COL32_BLACK, letters[edge]);
        canvas.AddText(places[edge], IM_COL32_WHITE, letters[edge]);
    }
}

/// The scan's slices; a drag in one of them sets two sides of the region.
void draw_slices(StartPage& page, StartPicture& picture, const ImVec2& room) {
    upload(page, picture);
    const glm::dvec2 size_px(page.picture()->size_px);
    const double scale =
        std::min(static_cast<double>(room.x) / size_px.x, static_cast<double>(room.y) / size_px.y);
    const ImVec2 first = ImGui::GetCursorScreenPos();
    const ImVec2 size{static_cast<float>(scale * size_px.x), static_cast<float>(scale * size_px.y)};
    ImGui::InvisibleButton("slices", size);
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    canvas.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(picture.texture->id())), first,
                    {first.x + size.x, first.y + size.y});
    const ScanBox& covers = page.look()->covers;
    for (const PreviewSlice& slice : preview_slices(covers, preview_mm_per_px)) {
        const auto corners = box_in_slice(covers, page.form.region, preview_mm_per_px, slice);
        const auto on_screen = [&](const glm::dvec2& px) {
            return ImVec2{first.x + static_cast<float>(scale * px.x),
                          first.y + static_cast<float>(scale * px.y)};
        };
        draw_letters(canvas, slice, on_screen(slice.first_px), on_screen(slice.first_px + slice.size_px));
        canvas.AddRect(on_screen(corners[0]), on_screen(corners[1]), IM_COL32(255, 150, 0, 255), 0.0f, 0,
                       2.0f);
    }
    const ImVec2 mouse = ImGui::GetMousePos();
    const glm::dvec2 at_px = glm::dvec2(mouse.x - first.x, mouse.y - first.y) / scale;
    if (ImGui::IsItemActivated()) picture.drag = at_px;
    if (picture.drag && ImGui::IsItemActive() &&
        glm::any(glm::greaterThan(glm::abs(at_px - *picture.drag), glm::dvec2(2.0))))
        if (const auto box = dragged_box(covers, page.form.region, preview_mm_per_px, *picture.drag, at_px))
            page.form.region = *box;
    if (!ImGui::IsItemActive()) picture.drag.reset();
}

/// What a segment is made of; the first choice leaves it open.
void draw_material(SegmentChoice& segment, const char* left_open) {
    ImGui::SetNextItemWidth(12.0f * ImGui::GetFontSize());
    if (!ImGui::BeginCombo("##material", segment.material.empty() ? left_open : segment.material.c_str()))
        return;
    const auto offer = [&](const char* shown, const std::string& material) {
        if (ImGui::Selectable(shown, segment.material == material)) segment.material = material;
    };
    offer(left_open, "");
    offer(tr("soft: no bone"), soft_material);
    for (const Material& material : shipped_materials()) offer(material.name.c_str(), material.name);
    ImGui::EndCombo();
}

void draw_segments(ImportForm& form) {
    for (std::size_t i = 0; i < form.segments.size(); ++i) {
        SegmentChoice& segment = form.segments[i];
        ImGui::PushID(static_cast<int>(i));
        ImGui::Checkbox(tr("protect"), &segment.is_protected);
        ImGui::SameLine();
        if (ImGui::Checkbox(tr("target"), &segment.is_target) && segment.is_target)
            for (std::size_t other = 0; other < form.segments.size(); ++other)
                if (other != i) form.segments[other].is_target = false;
        ImGui::SameLine();
        draw_material(segment, form.are_labels ? tr("as its name says") : tr("as its HU say"));
        ImGui::SameLine();
        ImGui::TextUnformatted(segment.name.c_str());
        ImGui::PopID();
    }
}

void draw_region(ImportForm& form) {
    constexpr std::array<const char*, 3> axes{"##x", "##y", "##z"};
    for (const bool is_low : {true, false}) {
        ImGui::PushID(is_low ? "low" : "high");
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(is_low ? tr("from") : tr("to"));
        for (int axis = 0; axis < 3; ++axis) {
            ImGui::SameLine();
            number_field(axes[static_cast<std::size_t>(axis)],
                         (is_low ? form.region.low_mm : form.region.high_mm)[axis], "%.1f");
        }
        ImGui::SameLine();
        ImGui::PopID();
    }
    ImGui::TextUnformatted(tr("mm LPS"));
}

void draw_import(StartPage& page, StartPicture& picture) {
    ImportForm& form = page.form;
    ImGui::TextUnformatted(form.scan.filename().c_str());
    if (const auto& look = page.look()) {
        ImGui::SameLine();
        ImGui::TextDisabled("%s", trf("HU {:.0f} to {:.0f}; drag a box in each slice: what becomes bone",
                                      look->least_hu, look->most_hu)
                                      .c_str());
    }
    if (page.look() && page.picture()) {
        const float line = ImGui::GetFrameHeightWithSpacing();
        const ImVec2 all = ImGui::GetContentRegionAvail();
        draw_slices(page, picture, {all.x, std::max(all.y - 9.0f * line, 4.0f * line)});
        draw_region(form);
        if (!form.are_labels) {
            number_field(tr("HU threshold"), form.threshold_hu, "%.0f");
            ImGui::SameLine();
        }
        number_field(tr("mm a voxel"), form.spacing_mm, "%.2f");
        form.spacing_mm = std::clamp(form.spacing_mm, 0.02, 10.0);
        if (!form.are_labels) {
            ImGui::SameLine();
            ImGui::Checkbox(tr("keep soft tissue"), &form.keeps_soft_tissue);
        }
        ImGui::BeginChild("segments", list_size(3.5f), false);
        if (button(tr("Look there"), !page.is_working())) page.look_again();
        ImGui::SameLine();
        if (button(tr("Add a segmentation ..."), !page.is_working()))
            page.show(StartPage::View::segmentation_browser);
        ImGui::SameLine();
        if (button(tr("Colour table ..."), !form.segments.empty() && !page.is_working()))
            page.show(StartPage::View::colours_browser);
        ImGui::SameLine();
        ImGui::TextDisabled("%s", trf("{:.0f} million voxels, {:.0f} MB at most", 1e-6 * voxels_of(form),
                                      1e-6 * most_memory_bytes(form))
                                      .c_str());
        draw_segments(form);
        ImGui::EndChild();
        text_field(tr("name of the case"), form.name, 14.0f * ImGui::GetFontSize());
    }
    if (!page.look() && !page.is_working()) {
        text_field(tr("mm between pixels and slices of a stack of pictures: x,y,z"), form.stack_spacing,
                   12.0f * ImGui::GetFontSize());
        ImGui::SameLine();
        if (ImGui::Button(tr("Look"))) page.look_again();
    }
    if (button(tr("Import"), page.look() && !page.is_working())) page.import();
    ImGui::SameLine();
    if (ImGui::Button(page.is_working() ? tr("Give up") : tr("Back"))) {
        if (page.is_working())
            page.give_up_work();
        else
            page.show(page.look() ? StartPage::View::cases : StartPage::View::scan_browser);
    }
    draw_message(page);
}

}  // namespace

glm::vec2 start_panel_size(const glm::vec2& available) {
    const float letter = ImGui::GetFontSize();
    return glm::min(available, glm::vec2(58.0f * letter, 44.0f * letter));
}

void draw_start_panel(StartPage& page, StartPicture& picture, const PanelPlace& place) {
    const InputPanel window("start", place, InputPanel::Background::filled, InputPanel::Size::whole,
                            InputPanel::Keys::reach_it);
    switch (page.view()) {
        case StartPage::View::cases:
            draw_cases(page, picture);
            break;
        case StartPage::View::import:
            draw_import(page, picture);
            break;
        case StartPage::View::scan_browser:
        case StartPage::View::labels_browser:
        case StartPage::View::segmentation_browser:
        case StartPage::View::colours_browser:
        case StartPage::View::recording_browser:
            draw_browser(page);
            break;
    }
}

}  // namespace osteomill
