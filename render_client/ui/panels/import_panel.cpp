#include "render_client/ui/panels/import_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "common/scene/material.h"
#include "common/scene/tissue_tables.h"
#include "common/words/translation.h"
#include "render_client/ui/panels/panel_painter.h"
#include "render_client/ui/panels/start_panel.h"

namespace osteomill {

namespace {

constexpr double mm_per_notch = 1.0;  // of the wheel

/// True if a person changes it.
/// `format`: of fmt. True if another number was written; a text that is none changes nothing.
bool number_field(const char* label, double& number, const char* format) {
    // Six of them stand in a row, with words for two more.
    const float letter = ImGui::GetFontSize();
    ImGui::SetNextItemWidth(std::clamp((ImGui::GetWindowContentRegionMax().x - 12.0f * letter) / 6.0f,
                                       3.0f * letter, 5.0f * letter));
    // Dear ImGui's own field drops a comma, so that 0,5 became 5.
    std::array<char, 32> text{};
    with_decimal_sign(fmt::format(fmt::runtime(format), number)).copy(text.data(), text.size() - 1);
    if (!ImGui::InputText(label, text.data(), text.size(), ImGuiInputTextFlags_AutoSelectAll)) return false;
    const auto written = number_written(text.data());
    if (written) number = *written;
    return written.has_value();
}

void upload(const StartPage& page, StartPicture& picture) {
    const std::optional<double> threshold_hu =
        page.form.are_labels ? std::nullopt : std::optional(page.form.threshold_hu);
    const bool is_new = picture.number != page.voxels_number() || picture.slices_at_mm != page.slices_at_mm ||
                        !picture.texture;
    if (!is_new && picture.threshold_hu == threshold_hu) return;
    if (!picture.texture) picture.texture.emplace();
    const Picture slices =
        picture_of(*page.voxels(), page.look()->covers, preview_mm_per_px, page.slices_at_mm);
    picture.texture->upload(
        threshold_hu ? with_contour(slices, *page.look(), preview_mm_per_px, *threshold_hu) : slices);
    picture.size_px = slices.size_px;
    picture.number = page.voxels_number();
    picture.slices_at_mm = page.slices_at_mm;
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

/// Lines in which the other two slices cross this one.
void draw_cross(ImDrawList& canvas, const ImVec2& low, const ImVec2& high, const ImVec2& at) {
    const ImU32 ink = IM_COL32(90, 200, 255, 110);
    canvas.AddLine({low.x, at.y}, {high.x, at.y}, ink);
    canvas.AddLine({at.x, low.y}, {at.x, high.y}, ink);
}

/// The scan's slices. The wheel goes through the one under the pointer; a drag in it sets two sides of the
/// region, and the other two follow.
void draw_slices(StartPage& page, StartPicture& picture, const ImVec2& room) {
    upload(page, picture);
    const glm::dvec2 size_px(picture.size_px);
    const double scale =
        std::min(static_cast<double>(room.x) / size_px.x, static_cast<double>(room.y) / size_px.y);
    const ImVec2 first = ImGui::GetCursorScreenPos();
    const ImVec2 size{static_cast<float>(scale * size_px.x), static_cast<float>(scale * size_px.y)};
    ImGui::InvisibleButton("slices", size);
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    canvas.AddImage(texture_of(picture.texture->id()), first, {first.x + size.x, first.y + size.y});
    const ScanBox& covers = page.look()->covers;
    for (const PreviewSlice& slice : preview_slices(covers, preview_mm_per_px)) {
        const auto corners = box_in_slice(covers, page.form.region, preview_mm_per_px, slice);
        const auto on_screen = [&](const glm::dvec2& px) {
            return ImVec2{first.x + static_cast<float>(scale * px.x),
                          first.y + static_cast<float>(scale * px.y)};
        };
        const ImVec2 low = on_screen(slice.first_px), high = on_screen(slice.first_px + slice.size_px);
        const ScanBox cross{page.slices_at_mm, page.slices_at_mm};
        draw_cross(canvas, low, high, on_screen(box_in_slice(covers, cross, preview_mm_per_px, slice)[0]));
        draw_letters(canvas, slice, low, high);
        canvas.AddRect(on_screen(corners[0]), on_screen(corners[1]), IM_COL32(255, 150, 0, 255), 0.0f, 0,
                       2.0f);
    }
    const ImVec2 mouse = ImGui::GetMousePos();
    const glm::dvec2 at_px = glm::dvec2(mouse.x - first.x, mouse.y - first.y) / scale;
    if (ImGui::IsItemActivated()) picture.drag = at_px;
    if (picture.drag && ImGui::IsItemActive() &&
        glm::any(glm::greaterThan(glm::abs(at_px - *picture.drag), glm::dvec2(2.0))))
        if (const auto box = dragged_box(covers, page.form.region, preview_mm_per_px, *picture.drag, at_px)) {
            const auto through = slice_at(covers, preview_mm_per_px, *picture.drag)->through_axis();
            const double stays_mm = page.slices_at_mm[through];
            page.form.region = *box;
            page.slices_at_mm = 0.5 * (box->low_mm + box->high_mm);
            page.slices_at_mm[through] = stays_mm;
        }
    if (!ImGui::IsItemActive()) picture.drag.reset();
    const double notches = static_cast<double>(ImGui::GetIO().MouseWheel);
    const auto under_pointer = slice_at(covers, preview_mm_per_px, at_px);
    if (notches == 0.0 || !under_pointer || !ImGui::IsItemHovered()) return;
    double& through_mm = page.slices_at_mm[under_pointer->through_axis()];
    through_mm = std::clamp(through_mm + mm_per_notch * notches, covers.low_mm[under_pointer->through_axis()],
                            covers.high_mm[under_pointer->through_axis()]);
}

/// Material of a segment; the first choice leaves it open.
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
        const auto [red, green, blue] = colour_of_segment(i);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float side = ImGui::GetFrameHeight();
        ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + 0.3f * side, at.y + side},
                                                  IM_COL32(red, green, blue, 255));
        ImGui::Dummy({0.3f * side, side});
        ImGui::SameLine();
        ImGui::Checkbox(tr("protect"), &segment.is_protected);
        ImGui::SameLine();
        if (segment.is_protected) {
            number_field("mm", segment.warn_mm, "{:.1f}");
            segment.warn_mm = std::clamp(segment.warn_mm, 0.0, most_warn_mm);
            if (ImGui::IsItemHovered())
                ImGui::SetTooltip("%s", tr("the window warns of a burr that is nearer"));
            ImGui::SameLine();
        }
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

/// A mark as a person sets it; a share in percent.
struct MarkField {
    const char* metric;
    const char* label;
    double first;  ///< once it is ticked
    double unit = 1.0;
};

/// Marks that a session has to reach; a mark that nobody could miss is not offered.
void draw_marks(ImportForm& form) {
    const std::array<MarkField, 5> fields{
        {{"time_s", tr("s at most"), 600.0},
         {"plan_removed_share", tr("% of the target at least"), 0.9, 0.01},
         {"plan_excess_mm3", tr("mm³ beside the target at most"), 10.0},
         {"structure_touches", tr("touches of what is protected at most"), 0.0},
         {"peak_force_n", tr("N at most"), 5.0}}};
    ImGui::TextUnformatted(tr("A session passes with:"));
    for (const MarkField& field : fields) {
        const PassMarkKind& kind = *pass_mark_kind(field.metric);
        if (!takes_mark(form, kind)) continue;
        ImGui::PushID(field.metric);
        bool is_set = form.pass.contains(field.metric);
        if (ImGui::Checkbox("##set", &is_set)) {
            if (is_set)
                form.pass[field.metric] = field.first;
            else
                form.pass.erase(field.metric);
        }
        ImGui::SameLine();
        ImGui::BeginDisabled(!is_set);
        double shown = (is_set ? form.pass[field.metric] : field.first) / field.unit;
        if (number_field(field.label, shown, "{:g}") && is_set)
            form.pass[field.metric] = std::clamp(shown * field.unit, kind.low, kind.high);
        ImGui::EndDisabled();
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
                         (is_low ? form.region.low_mm : form.region.high_mm)[axis], "{:.1f}");
        }
        ImGui::SameLine();
        ImGui::PopID();
    }
    ImGui::TextUnformatted(tr("mm LPS"));
}

/// Behind the widgets before, or below them where it would be cut off.
void draw_loose_parts(StartPage& page) {
    const char* const label = tr("leave out small loose parts");
    std::string count;
    if (!page.form.are_labels) {
        const auto loose = page.loose_parts();
        count = !loose ? tr("(being counted ...)")
                       : trf("(about {}, {:.1f} mm³ in all)", loose->count, loose->mm3);
    }
    const ImGuiStyle& style = ImGui::GetStyle();
    const float width = ImGui::GetFrameHeight() + ImGui::CalcTextSize((label + count).c_str()).x +
                        style.ItemInnerSpacing.x + 2.0f * style.ItemSpacing.x;
    if (ImGui::GetItemRectMax().x + width <= ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x)
        ImGui::SameLine();
    ImGui::Checkbox(label, &page.form.leaves_out_specks);
    if (ImGui::IsItemHovered()) {
        // Above: the count stands beside it.
        ImGui::SetNextWindowPos(ImGui::GetItemRectMin(), ImGuiCond_Always, {0.0f, 1.0f});
        ImGui::SetTooltip("%s", tr("bone of less than 2 mm³ that touches nothing else, such as noise"));
    }
    if (count.empty()) return;
    ImGui::SameLine();
    ImGui::TextDisabled("%s", count.c_str());
}

/// The size of the bone that it makes, or why that is too much.
void draw_size(const ImportForm& form, const ScanPreview& look) {
    const std::string threshold = wrong_with_threshold(form, look);
    const std::string wrong = threshold.empty() ? wrong_with_size(form) : threshold;
    const std::string size =
        trf("{:.0f} million voxels, {:.0f} MB at most, some {:.0f} s (estimated)", 1e-6 * voxels_of(form),
            1e-6 * most_memory_bytes(form), std::ceil(estimated_s(form, look)));
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(wrong.empty() ? ImGuiCol_TextDisabled
                                                                                : ImGuiCol_NavHighlight));
    ImGui::TextWrapped("%s", (wrong.empty() ? size : wrong).c_str());
    ImGui::PopStyleColor();
}

}  // namespace

void draw_import(StartPage& page, StartPicture& picture) {
    ImportForm& form = page.form;
    ImGui::TextUnformatted(form.scan.filename().c_str());
    if (const auto& look = page.look()) {
        if (!form.are_labels) {
            ImGui::SameLine();
            ImGui::TextDisabled("%s", trf("HU {:.0f} to {:.0f};", look->least_hu, look->most_hu).c_str());
        }
        ImGui::SameLine();
        ImGui::TextDisabled("%s", tr("drag a box in two slices: what becomes bone; wheel: other slices"));
    }
    if (page.look() && page.voxels()) {
        const float line = ImGui::GetFrameHeightWithSpacing();
        const ImVec2 all = ImGui::GetContentRegionAvail();
        // An import that is under way has the form as it was when it began.
        ImGui::BeginDisabled(page.is_importing());
        draw_slices(page, picture, {all.x, std::max(all.y - 9.0f * line, 4.0f * line)});
        draw_region(form);
        if (!form.are_labels) {
            number_field(tr("HU threshold"), form.threshold_hu, "{:.0f}");
            ImGui::SameLine();
        }
        if (!form.is_spacing_chosen) form.spacing_mm = default_spacing_mm(form, *page.look());
        const std::string per_voxel = trf("mm a voxel ({:g} to {:g})", finest_voxel_mm, coarsest_voxel_mm);
        if (number_field(per_voxel.c_str(), form.spacing_mm, "{:.2f}")) form.is_spacing_chosen = true;
        form.spacing_mm = std::clamp(form.spacing_mm, finest_voxel_mm, coarsest_voxel_mm);
        if (!form.are_labels) {
            ImGui::SameLine();
            ImGui::Checkbox(tr("keep soft tissue"), &form.keeps_soft_tissue);
        }
        draw_loose_parts(page);
        ImGui::BeginChild("segments", list_size(3.5f), false);
        if (button(tr("Add a segmentation ..."), !page.is_working()))
            page.show(StartPage::View::segmentation_browser);
        ImGui::SameLine();
        if (button(tr("Colour table ..."), !form.segments.empty() && !page.is_working()))
            page.show(StartPage::View::colours_browser);
        ImGui::SameLine();
        draw_size(form, *page.look());
        draw_segments(form);
        draw_marks(form);
        ImGui::EndChild();
        text_field(tr("name of the case"), form.name, 14.0f * ImGui::GetFontSize());
        ImGui::SameLine();
        text_field<256>(tr("description"), form.description, 18.0f * ImGui::GetFontSize());
        ImGui::EndDisabled();
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
            page.go_back();
    }
    draw_message(page);
}

}  // namespace osteomill
