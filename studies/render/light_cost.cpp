#include "studies/render/light_cost.h"

#include <fmt/format.h>

#include "render_client/volume/passes/raycast_renderer.h"
#include "render_client/volume/textures/empty_space.h"

namespace osteomill::study {

std::vector<LightRow> light_costs(const TrialBone& trial, const glm::ivec2& size_px, int times) {
    const BoneTextures textures(trial.bone, trial.tissues);
    std::vector<LightRow> rows;
    const auto draw = [&](const std::string& what, const SceneLook& look) {
        RaycastRenderer renderer;
        renderer.set_look(look);
        rows.push_back({what, timed_drawing(renderer, textures, trial.close_up, size_px, times).cost});
    };
    draw("frame, no ambient occlusion", {.ambient_occlusion = false});
    draw("frame, ambient occlusion (default)", {});
    draw("frame, ambient occlusion and wet", {.specular = 0.4f});

    TrialBone carved = trial;
    const std::vector<BrickChange> changes = carve_in_view(carved, 5.0);
    EmptySpace blocks(trial.bone, stored_box(trial.bone.content()));
    rows.push_back({"map of blocks after a carve by the 5 mm burr",
                    median_cost([&] { blocks.update(trial.bone, changes); },
                                [&] { blocks.update(carved.bone, changes); }, times)});
    return rows;
}

std::string csv_of(const std::vector<LightRow>& rows) {
    std::string csv = "what,wall_ms,cpu_ms\n";
    for (const LightRow& row : rows)
        csv += fmt::format("\"{}\",{:.3f},{:.3f}\n", row.what, row.cost.wall_ms, row.cost.cpu_ms);
    return csv;
}

}  // namespace osteomill::study
