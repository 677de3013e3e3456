#include "render_client/ui/panels/start_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "common/scene/material.h"
#include "render_client/ui/panels/input_panel.h"

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

void draw_cases(StartPage& page) {
    ImGui::TextUnformatted("Start a session on this machine");
    ImGui::BeginChild("cases", list_size(page.report() ? 5.0f : 4.0f), true);
    for (std::size_t i = 0; i < page.cases().size(); ++i) {
        const ShelvedCase& each = page.cases()[i];
        const bool is_built_in = i < built_in_cases.size();
        if (ImGui::Selectable(
                fmt::format("{}{}##{}", each.name, is_built_in ? "  (built in)" : "", i).c_str(),
                page.chosen == i))
            page.chosen = i;
    }
    ImGui::EndChild();
    text_field("trainee", page.trainee, 14.0f * ImGui::GetFontSize());
    if (button("Start", !page.is_session_running())) page.start();
    ImGui::SameLine();
    if (button("Import a scan ...", !page.is_session_running())) page.show(StartPage::View::scan_browser);
    ImGui::SameLine();
    if (button("Import labels ...", !page.is_session_running())) page.show(StartPage::View::labels_browser);
    ImGui::SameLine();
    if (button("Compare all sessions", !page.is_working())) page.compare_sessions();
    ImGui::SameLine();
    if (ImGui::Button("Hide this")) page.is_hidden = true;
    if (page.report()) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted("The last session:");
        ImGui::SameLine();
        if (ImGui::Button("Open its report")) page.open_report();
        ImGui::SameLine();
        ImGui::TextUnformatted(page.report()->string().c_str());
    }
    draw_message(page);
}

void draw_browser(StartPage& page) {
    const bool is_for_scan =
        page.view() == StartPage::View::scan_browser || page.view() == StartPage::View::labels_browser;
    ImGui::TextUnformatted(
        is_for_scan ? "A DICOM folder, a NRRD, NIfTI or MetaImage file, or a folder of PNG or TIFF pictures"
        : page.view() == StartPage::View::colours_browser
            ? "Names and colours of labels: a table of 3D Slicer (.ctbl, .csv) or ITK-SNAP"
            : "A segmentation (.seg.nrrd, DICOM), or a label map");
    ImGui::TextDisabled("%s", page.listing().folder.c_str());
    const FolderListing listing = page.listing();  // a click replaces it
    ImGui::BeginChild("files", list_size(2.0f), true);
    if (listing.folder.has_parent_path() && ImGui::Selectable("../  (up)"))
        page.browse(listing.folder.parent_path());
    for (const std::string& name : listing.folders)
        if (ImGui::Selectable((name + "/").c_str())) page.browse(listing.folder / name);
    for (const std::string& name : listing.files)
        if (ImGui::Selectable(name.c_str())) page.take(listing.folder / name);
    ImGui::EndChild();
    if (!listing.problem.empty()) ImGui::TextUnformatted(listing.problem.c_str());
    if (is_for_scan) {
        if (button("This folder", !listing.files.empty())) page.take(listing.folder);
        ImGui::SameLine();
    }
    if (ImGui::Button("Back")) page.show(is_for_scan ? StartPage::View::cases : StartPage::View::import);
}

void upload(const StartPage& page, StartPicture& picture) {
    if (picture.number == page.picture_number() && picture.texture) return;
    const Picture& from = *page.picture();
    std::vector<std::uint8_t> rgba;
    rgba.reserve(from.rgb.size() / 3 * 4);
    for (std::size_t i = 0; i < from.rgb.size(); i += 3) {
        rgba.insert(rgba.end(), from.rgb.begin() + static_cast<std::ptrdiff_t>(i),
                    from.rgb.begin() + static_cast<std::ptrdiff_t>(i + 3));
        rgba.push_back(255);
    }
    if (!picture.texture) picture.texture.emplace();
    picture.texture->upload(from.size_px, rgba);
    picture.number = page.picture_number();
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
    offer("soft: no bone", soft_material);
    for (const Material& material : shipped_materials()) offer(material.name.c_str(), material.name);
    ImGui::EndCombo();
}

void draw_segments(ImportForm& form) {
    for (std::size_t i = 0; i < form.segments.size(); ++i) {
        SegmentChoice& segment = form.segments[i];
        ImGui::PushID(static_cast<int>(i));
        ImGui::Checkbox("protect", &segment.is_protected);
        ImGui::SameLine();
        if (ImGui::Checkbox("target", &segment.is_target) && segment.is_target)
            for (std::size_t other = 0; other < form.segments.size(); ++other)
                if (other != i) form.segments[other].is_target = false;
        ImGui::SameLine();
        draw_material(segment, form.are_labels ? "as its name says" : "as its HU say");
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
        ImGui::TextUnformatted(is_low ? "from" : "to");
        for (int axis = 0; axis < 3; ++axis) {
            ImGui::SameLine();
            number_field(axes[static_cast<std::size_t>(axis)],
                         (is_low ? form.region.low_mm : form.region.high_mm)[axis], "%.1f");
        }
        ImGui::SameLine();
        ImGui::PopID();
    }
    ImGui::TextUnformatted("mm LPS");
}

void draw_import(StartPage& page, StartPicture& picture) {
    ImportForm& form = page.form;
    ImGui::TextUnformatted(form.scan.filename().c_str());
    if (const auto& look = page.look()) {
        ImGui::SameLine();
        ImGui::TextDisabled("HU %.0f to %.0f; drag a box in each slice: what becomes bone", look->least_hu,
                            look->most_hu);
    }
    if (page.look() && page.picture()) {
        const float line = ImGui::GetFrameHeightWithSpacing();
        const ImVec2 all = ImGui::GetContentRegionAvail();
        draw_slices(page, picture, {all.x, std::max(all.y - 9.0f * line, 4.0f * line)});
        draw_region(form);
        if (!form.are_labels) {
            number_field("HU threshold", form.threshold_hu, "%.0f");
            ImGui::SameLine();
        }
        number_field("mm a voxel", form.spacing_mm, "%.2f");
        form.spacing_mm = std::clamp(form.spacing_mm, 0.02, 10.0);
        if (!form.are_labels) {
            ImGui::SameLine();
            ImGui::Checkbox("keep soft tissue", &form.keeps_soft_tissue);
        }
        ImGui::BeginChild("segments", list_size(3.5f), false);
        if (button("Look there", !page.is_working())) page.look_again();
        ImGui::SameLine();
        if (button("Add a segmentation ...", !page.is_working()))
            page.show(StartPage::View::segmentation_browser);
        ImGui::SameLine();
        if (button("Colour table ...", !form.segments.empty() && !page.is_working()))
            page.show(StartPage::View::colours_browser);
        ImGui::SameLine();
        ImGui::TextDisabled("%.0f million voxels", 1e-6 * voxels_of(form));
        draw_segments(form);
        ImGui::EndChild();
        text_field("name of the case", form.name, 14.0f * ImGui::GetFontSize());
    }
    if (!page.look() && !page.is_working()) {
        text_field("mm between pixels and slices of a stack of pictures: x,y,z", form.stack_spacing,
                   12.0f * ImGui::GetFontSize());
        ImGui::SameLine();
        if (ImGui::Button("Look")) page.look_again();
    }
    if (button("Import", page.look() && !page.is_working())) page.import();
    ImGui::SameLine();
    if (ImGui::Button(page.is_working() ? "Give up" : "Back")) {
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
    const InputPanel window("start", place);
    switch (page.view()) {
        case StartPage::View::cases:
            draw_cases(page);
            break;
        case StartPage::View::import:
            draw_import(page, picture);
            break;
        case StartPage::View::scan_browser:
        case StartPage::View::labels_browser:
        case StartPage::View::segmentation_browser:
        case StartPage::View::colours_browser:
            draw_browser(page);
            break;
    }
}

}  // namespace osteomill
