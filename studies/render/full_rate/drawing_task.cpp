#include "studies/render/full_rate/drawing_task.h"

#include <nlohmann/json.hpp>

namespace osteomill::study {

nlohmann::ordered_json json_of(const DrawingTask& task) {
    const Camera& view = task.first_view;
    return {{"phantom", task.phantom},
            {"size_px", {task.size_px.x, task.size_px.y}},
            {"frames", task.frames},
            {"first_view",
             {{"target_mm", {view.target_mm.x, view.target_mm.y, view.target_mm.z}},
              {"distance_mm", view.distance_mm},
              {"azimuth_rad", view.azimuth_rad},
              {"elevation_rad", view.elevation_rad},
              {"field_of_view_rad", view.field_of_view_rad},
              {"near_mm", view.near_mm},
              {"far_mm", view.far_mm}}}};
}

DrawingTask task_of(const nlohmann::ordered_json& json) {
    const nlohmann::ordered_json& view = json.at("first_view");
    const std::array<double, 3> target_mm = view.at("target_mm");
    const std::array<int, 2> size_px = json.at("size_px");
    return {.phantom = json.at("phantom"),
            .size_px = {size_px[0], size_px[1]},
            .frames = json.at("frames"),
            .first_view = {.target_mm = {target_mm[0], target_mm[1], target_mm[2]},
                           .distance_mm = view.at("distance_mm"),
                           .azimuth_rad = view.at("azimuth_rad"),
                           .elevation_rad = view.at("elevation_rad"),
                           .field_of_view_rad = view.at("field_of_view_rad"),
                           .near_mm = view.at("near_mm"),
                           .far_mm = view.at("far_mm")}};
}

}  // namespace osteomill::study
