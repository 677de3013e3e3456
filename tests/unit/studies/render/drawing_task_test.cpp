#include "studies/render/full_rate/drawing_task.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace osteomill::study {
namespace {

TEST(DrawingTask, IsTheSameAfterAFile) {
    const DrawingTask task{.phantom = "head",
                           .size_px = {2560, 1440},
                           .frames = 60,
                           .first_view = {.target_mm = {1.5, -2.0, 75.25},
                                          .distance_mm = 81.0,
                                          .azimuth_rad = 0.3,
                                          .elevation_rad = -0.2,
                                          .field_of_view_rad = 0.5,
                                          .near_mm = 2.0,
                                          .far_mm = 900.0}};
    const DrawingTask read = task_of(nlohmann::ordered_json::parse(json_of(task).dump()));
    EXPECT_EQ(read.phantom, task.phantom);
    EXPECT_EQ(read.size_px, task.size_px);
    EXPECT_EQ(read.frames, task.frames);
    EXPECT_EQ(read.first_view, task.first_view);
}

TEST(DrawingTask, LacksNothing) {
    nlohmann::ordered_json json = json_of(DrawingTask{});
    json.at("first_view").erase("near_mm");
    EXPECT_THROW(task_of(json), nlohmann::json::exception);
}

}  // namespace
}  // namespace osteomill::study
