#include "render_client/ui/panels/structure_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/words/translation.h"

namespace osteomill {

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
    const double mm3 = std::max(now.removed_mm3, now.entered_mm3);
    if (mm3 > 0.0) when += fmt::format(", {:.2f} mm\u00b3", mm3);
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
