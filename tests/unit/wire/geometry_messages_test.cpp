#include "common/wire/geometry_messages.h"

#include <gmock/gmock.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "osteomill/v2/session.pb.h"

namespace osteomill {
namespace {

const Viewpoint from_the_front{.eye_mm = {10.25, -80.5, 60.125},
                               .rotation = glm::angleAxis(2.0, glm::normalize(glm::dvec3(1, 2, -3))),
                               .field_of_view_rad = glm::radians(34.5)};

std::string refusal(const v2::Viewpoint& message) {
    const auto read = viewpoint_from(message);
    const auto* error = std::get_if<WireError>(&read);
    return error ? error->line : "nothing is wrong";
}

TEST(ViewpointMessage, CarriesAViewpoint) {
    const auto read = std::get<Viewpoint>(viewpoint_from(to_message(from_the_front)));
    EXPECT_EQ(read.eye_mm, from_the_front.eye_mm);
    EXPECT_NEAR(glm::length(read.rotation), 1.0, 1e-15);
    EXPECT_GT(glm::dot(read.rotation, from_the_front.rotation), 1.0 - 1e-12);
    EXPECT_NEAR(read.field_of_view_rad, from_the_front.field_of_view_rad, 1e-7);
    EXPECT_LE(to_message(from_the_front).ByteSizeLong(), 54U);
}

TEST(ViewpointMessage, RefusesWhatNobodyCanSeeFrom) {
    using ::testing::HasSubstr;
    constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
    for (const double far_mm : {not_a_number, 10'001.0, std::numeric_limits<double>::infinity()}) {
        Viewpoint far = from_the_front;
        far.eye_mm.y = far_mm;
        EXPECT_THAT(refusal(to_message(far)), HasSubstr("no place within 10 m"));
    }
    for (const double scale : {0.0, 0.99, 1.01, not_a_number}) {
        Viewpoint stretched = from_the_front;
        stretched.rotation *= scale;
        EXPECT_THAT(refusal(to_message(stretched)), HasSubstr("no rotation"));
    }
    for (const double angle_rad : {0.0, 0.01, 3.0, -0.6, not_a_number}) {
        Viewpoint wide = from_the_front;
        wide.field_of_view_rad = angle_rad;
        EXPECT_THAT(refusal(to_message(wide)), HasSubstr("field of view"));
    }
    EXPECT_THAT(refusal({}), HasSubstr("no rotation")) << "an empty one";
}

}  // namespace
}  // namespace osteomill
