#include "render_client/ui/start/import_form.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/bone/grid.h"
#include "common/text/pattern.h"
#include "common/words/translation.h"

namespace osteomill {

namespace {

/// With '=': a region may begin with a minus.
std::string region_option(const ScanBox& region) {
    const glm::dvec3& low = region.low_mm;
    const glm::dvec3& high = region.high_mm;
    return fmt::format("--region={:.2f},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f}", low.x, low.y, low.z, high.x,
                       high.y, high.z);
}

/// bone_import with all files that go in.
std::vector<std::string> command_with_files(const std::string& bone_import, const ImportForm& form) {
    std::vector<std::string> command{bone_import, (form.are_labels ? "--labels=" : "") + form.scan.string()};
    for (const auto& file : form.segmentations) command.push_back("--segmentation=" + file.string());
    if (form.colours) command.push_back("--colours=" + form.colours->string());
    if (!form.stack_spacing.empty()) command.push_back("--stack-spacing=" + form.stack_spacing);
    return command;
}

}  // namespace

bool takes_mark(const ImportForm& form, const PassMarkKind& kind) {
    const std::string_view metric = kind.metric;
    if (metric.starts_with("plan_")) return std::ranges::any_of(form.segments, &SegmentChoice::is_target);
    if (metric == "structure_touches")
        return std::ranges::any_of(form.segments, &SegmentChoice::is_protected);
    return true;
}

double voxels_of(const ImportForm& form) {
    const glm::dvec3 edges = (form.region.high_mm - form.region.low_mm) / form.spacing_mm + 1.0;
    return edges.x * edges.y * edges.z;
}

std::string wrong_with_size(const ImportForm& form) {
    if (voxels_of(form) <= most_imported_voxels) return {};
    return trf(
        "the region has about {:.1f} billion voxels; {:.1f} are the most: drag a smaller one, or choose "
        "larger voxels",
        1e-9 * voxels_of(form), 1e-9 * most_imported_voxels);
}

std::string wrong_with_threshold(const ImportForm& form, const ScanPreview& look) {
    // The preview's voxels are means: a thin implant may have more HU than any of them.
    constexpr double most_of_scanners_hu = 3071.0;
    const double most_hu = std::max(look.most_hu, most_of_scanners_hu);
    if (form.are_labels || form.threshold_hu <= most_hu) return {};
    return trf("the HU threshold is {:g}, and nothing of the scan is bone: choose one of at most {:.0f}",
               form.threshold_hu, most_hu);
}

double most_memory_bytes(const ImportForm& form) {
    return session_bytes_per_voxel * voxels_of(form);
}

double estimated_s(const ImportForm& form, const ScanPreview& look) {
    const ImportForm looked_at{.region = look.covers, .spacing_mm = preview_mm_per_px};
    const double reading_s = std::max(look.took_s - voxels_of(looked_at) / imported_voxels_per_s, 0.0);
    return reading_s + voxels_of(form) / imported_voxels_per_s;
}

std::vector<std::string> look_command(const std::string& bone_import, const ImportForm& form,
                                      const std::filesystem::path& voxels) {
    std::vector<std::string> command = command_with_files(bone_import, form);
    command.insert(command.end(), {"--preview", voxels.string()});
    return command;
}

std::vector<std::string> import_command(const std::string& bone_import, const ImportForm& form,
                                        const std::filesystem::path& folder) {
    std::vector<std::string> command = command_with_files(bone_import, form);
    command.insert(command.end(), {"--case", folder.string(), region_option(form.region),
                                   fmt::format("--spacing-mm={}", form.spacing_mm)});
    if (!form.are_labels) command.push_back(fmt::format("--threshold-hu={}", form.threshold_hu));
    if (!form.are_labels && form.keeps_soft_tissue) command.emplace_back("--keep-soft-tissue");
    if (form.leaves_out_specks) command.emplace_back("--leave-out-specks");
    for (const SegmentChoice& segment : form.segments) {
        if (segment.is_protected)
            command.push_back(fmt::format("--protect={}={}", segment.name, segment.warn_mm));
        if (segment.is_target) command.push_back("--target=" + segment.name);
        if (!segment.material.empty())
            command.push_back("--material=" + segment.name + "=" + segment.material);
    }
    if (!form.description.empty()) command.push_back("--description=" + form.description);
    for (const PassMarkKind& kind : pass_mark_kinds)
        if (const auto mark = form.pass.find(kind.metric); mark != form.pass.end() && takes_mark(form, kind))
            command.push_back(fmt::format("--pass={}={}", kind.metric, mark->second));
    return command;
}

std::string without_options(std::string line) {
    using Words = std::pair<std::string_view, std::string_view>;
    constexpr std::array fields{Words{"--threshold-hu", "HU threshold"}, Words{"--spacing-mm", "voxel"},
                                Words{"--region", "region"},
                                Words{"--stack-spacing", "spacing of the stack"}};
    for (const auto& [option, words] : fields)
        for (std::size_t at = line.find(option); at != std::string::npos;
             at = line.find(option, at + words.size()))
            line.replace(at, option.size(), words);
    return line;
}

std::string specks_said(const std::string& said) {
    static const Pattern words(
        R"((\d+) parts? of bone of less than (\S+) mm3, (\S+) mm3 in all, touch\w* nothing else; (left out)?)");
    const std::vector<std::string> found = words.first_in(said);
    if (found.empty()) return {};
    const std::string parts = with_decimal_sign(
        trf("loose parts of bone of less than {} mm³ each: {}, {} mm³ in all", found[2], found[1], found[3]));
    return parts + (found[4].empty() ? tr(", kept") : tr(", left out"));
}

double default_spacing_mm(const ImportForm& form, const ScanPreview& look) {
    constexpr double usual_mm = 0.1;
    const double fine_mm =
        look.finest_voxel_mm > 0.0 ? std::clamp(look.finest_voxel_mm, finest_voxel_mm, usual_mm) : usual_mm;
    return usual_spacing_mm(form.region.high_mm - form.region.low_mm, fine_mm, form.available_bytes);
}

void take_look(ImportForm& form, const ScanPreview& look, bool is_another_scan) {
    if (is_another_scan) {
        form.region = look.covers;
        form.spacing_mm = default_spacing_mm(form, look);
        form.is_spacing_chosen = false;
    }
    std::vector<SegmentChoice> segments;
    for (const std::string& name : look.segments) {
        const auto known = std::find_if(form.segments.begin(), form.segments.end(),
                                        [&](const SegmentChoice& choice) { return choice.name == name; });
        segments.push_back(known == form.segments.end() ? SegmentChoice{.name = name} : *known);
    }
    form.segments = std::move(segments);
}

}  // namespace osteomill
